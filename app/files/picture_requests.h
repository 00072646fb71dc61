#pragma once

#include <optional>
#include <vector>

#include "app/document/session.h"
#include "app/files/folder.h"
#include "app/files/picture_task.h"

namespace mesher::app {

/// Opens the dialog of pictures with a new name, in the folder of the last picture.
void show_picture_dialog(Session& session);
/// Chooses between a still picture and a turntable, and gives the name the usual ending for it.
void choose_turn(PictureDialog& dialog, bool is_turn);
/// Handles the dialog's button: requests the picture and closes the dialog, or goes to a folder, or
/// sets the problem to the reason why it cannot. `shown`: the list of the dialog.
void submit_picture(Session& session, const std::vector<const FolderEntry*>& shown);
/// Takes the requested picture, if there is one. O(V + F), because what it shows is copied.
std::optional<PictureTask> begin_requested_picture(Session& session);

}  // namespace mesher::app
