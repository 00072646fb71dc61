#include "app/files/open.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "app/files/browse.h"
#include "app/files/paths.h"

namespace mesher::app {
namespace {

namespace fs = std::filesystem;

// A hundred dropped pictures are refused with fewer lines than that.
constexpr std::size_t kMostReasons = 5;

fs::path start_folder(const Session& session) {
  if (is_folder(session.preferences.open_folder)) return session.preferences.open_folder;
  const fs::path own = session.document.file.parent_path();
  return is_folder(own) ? own : fs::path(".");
}

}  // namespace

void show_open_dialog(Session& session) {
  OpenDialog& dialog = session.open_dialog;
  dialog.is_shown = true;
  dialog.browser.searches = true;
  dialog.browser.filter.shows_hidden = session.preferences.shows_hidden_files;
  go_to(dialog.browser, start_folder(session));
}

void submit_open(Session& session, const std::vector<const FolderEntry*>& shown) {
  OpenDialog& dialog = session.open_dialog;
  if (!dialog.opening.empty()) return;
  if (const std::optional<fs::path> file = submit(dialog.browser, shown)) {
    dialog.opening = *file;
    request_open(session, *file);
  }
}

void request_open(Session& session, const fs::path& file) {
  session.wants_open.push_back(file);
}

void note_opened(Session& session, const fs::path& file) {
  session.shows_start = false;
  remember_opened(session.preferences, file);
  OpenDialog& dialog = session.open_dialog;
  if (dialog.opening != file) return;
  dialog.opening.clear();
  dialog.is_shown = false;
}

void note_canceled(Session& session, const fs::path& file) {
  session.open_dialog.opening.clear();
  session.document.notice = "canceled: " + file.string();
  session.shows_start |= session.document.opening == 0;
}

void note_not_opened(Session& session, const std::vector<std::string>& reasons) {
  OpenDialog& dialog = session.open_dialog;
  std::string text;
  for (std::size_t i = 0; i < std::min(reasons.size(), kMostReasons); ++i)
    text += (i == 0 ? "" : "\n") + reasons[i];
  if (reasons.size() > kMostReasons)
    text += fmt::format("\nand {} more files could not be opened", reasons.size() - kMostReasons);
  const bool is_dialogs = dialog.is_shown && !dialog.opening.empty();
  dialog.opening.clear();
  if (is_dialogs) {
    refuse_text(dialog.browser, text);
  } else {
    session.document.error = text;
    // If it is shown already, another file can be chosen there.
    session.shows_start |= session.document.opening == 0;
  }
}

}  // namespace mesher::app
