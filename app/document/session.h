#pragma once

#include <deque>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "app/document/document.h"
#include "app/document/file_browser.h"
#include "app/document/leaving.h"
#include "app/document/lost_edits.h"
#include "app/document/picture_dialog.h"
#include "app/document/preferences.h"
#include "app/document/saving.h"
#include "app/document/tabs.h"
#include "app/document/tool.h"
#include "app/document/view.h"

namespace mesher::app {

/// The state of the program: a document, how it is looked at, and what is open beside it. It has no
/// window and no GPU: the viewer and scripts drive the same session, so that both give the same
/// result. Functions take the part that they need.
struct Session {
  Document document;
  View view;
  Tabs tabs;
  Saving saving;
  OpenDialog open_dialog;
  PictureDialog picture;
  Preferences preferences;
  /// Document::opening of the model that is shown because none was named; 0: there is none.
  std::uint64_t sample = 0;

  std::deque<LostEdits> lost;  ///< asks what to do with the first ones, until there are none
  /// Asks whether to save the edits of the shown document before this; none: no question is open.
  std::optional<Leaving> unsaved;

  Tool tool = Tool::simplify;       ///< its panel is shown
  bool shows_info = true;           ///< the panels at the sides
  bool panel_covers_model = false;  ///< the window is so small that the tool's panel lies over it
  bool shows_help = false;
  bool shows_palette = false;
  bool shows_start = false;  ///< the start screen
  /// Models of the start screen that come with mesher. Listed when it is first drawn.
  std::vector<std::filesystem::path> samples;

  // Requests to the viewer or the script that runs the session.
  bool wants_quit = false;
  std::vector<std::filesystem::path> wants_open;  ///< each in a tab of its own
  std::deque<LostEdits> wants_restore;
  bool wants_screenshot = false;
  bool wants_context_menu = false;
  std::optional<std::string> copied;  ///< text for the clipboard
};

/// Returns whether a question is open. Keys and clicks answer it, and do nothing else.
bool has_question(const Session& session);

/// Shows a model: computes its statistics, discards the edits of the previous model, and frames the
/// model from the camera's current angle. O(F).
void show_model(Session& session, Model&& model, const std::filesystem::path& file);
/// As above, with statistics that were computed elsewhere, such as in a background job. O(1).
void show_model(Session& session, Model&& model, const Statistics& statistics,
                const std::filesystem::path& file);

}  // namespace mesher::app
