#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "app/document/session.h"
#include "app/files/folder.h"

namespace mesher::app {

/// Opens the dialog in the folder of the file that was opened last.
void show_open_dialog(Session& session);
/// Handles the dialog's button: requests the chosen file. The dialog stays until it was read.
void submit_open(Session& session, const std::vector<const FolderEntry*>& shown);
/// Requests a file of the list of recent ones, or a sample.
void request_open(Session& session, const std::filesystem::path& file);

/// Call when a file was opened: closes the dialog and the start screen, and remembers the file.
void note_opened(Session& session, const std::filesystem::path& file);
/// Call when the opening of a file was canceled.
void note_canceled(Session& session, const std::filesystem::path& file);
/// Call when files could not be opened. The dialog that asked for one stays and says why;
/// otherwise, the document's error does.
void note_not_opened(Session& session, const std::vector<std::string>& reasons);

}  // namespace mesher::app
