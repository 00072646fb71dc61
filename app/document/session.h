#pragma once

#include <filesystem>

#include "app/document/document.h"
#include "app/document/saving.h"
#include "app/document/view.h"

namespace mesher::app {

/// The state of the program: a document, how it is looked at, and what is open beside it. It has no
/// window and no GPU: the viewer and scripts drive the same session, so that both give the same
/// result. Functions take the part that they need.
struct Session {
  Document document;
  View view;
  Saving saving;

  bool shows_info = true;
  bool shows_help = false;
  bool shows_open_dialog = false;

  // Requests to the viewer or the script that runs the session.
  bool wants_quit = false;
  bool wants_screenshot = false;
};

/// Shows a model: computes its statistics, discards the edits of the previous model, and frames the
/// model from the camera's current angle. O(F).
void show_model(Session& session, Model&& model, const std::filesystem::path& file);
/// As above, with statistics that were computed elsewhere, such as in a background job. O(1).
void show_model(Session& session, Model&& model, const Statistics& statistics,
                const std::filesystem::path& file);

}  // namespace mesher::app
