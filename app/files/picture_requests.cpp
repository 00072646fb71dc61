#include "app/files/picture_requests.h"

#include <utility>

#include "app/files/browse.h"
#include "app/files/paths.h"
#include "app/files/turntable.h"

namespace mesher::app {
namespace {

namespace fs = std::filesystem;

PictureRequest request_of(const PictureDialog& dialog, const fs::path& file) {
  return {.file = file,
          .options = dialog.options,
          .turn = dialog.is_turn ? std::optional(dialog.turn) : std::nullopt};
}

/// The first file that would be overwritten.
fs::path first_file(const PictureRequest& request) {
  const bool is_numbered = request.file.filename().string().find('#') != std::string::npos;
  return request.turn && is_numbered ? frame_file(request.file, 0) : request.file;
}

std::string problem_of(Session& session, const PictureRequest& request) {
  if (request.file.empty()) return "enter a file name";
  const std::string reason = objection(request, session.view);
  if (!reason.empty()) return reason;
  const fs::path folder = request.file.parent_path();
  if (!is_folder(folder)) return "there is no folder " + folder.string();
  return overwrite_question(session.picture.asked, first_file(request));
}

}  // namespace

void show_picture_dialog(Session& session) {
  PictureDialog& dialog = session.picture;
  const std::string& model = session.document.model.name;
  dialog.is_shown = true;
  dialog.asked.clear();
  dialog.browser.filter.kind = FileKind::pictures;
  dialog.browser.filter.shows_hidden = session.preferences.shows_hidden_files;
  go_to(dialog.browser, is_folder(session.preferences.picture_folder)
                            ? session.preferences.picture_folder
                            : next_screenshot(model).parent_path());
  set_text(dialog.browser,
           free_picture_name(dialog.browser.folder, "mesher-" + fs::path(model).stem().string())
               .filename()
               .string());
  choose_turn(dialog, dialog.is_turn);
}

void choose_turn(PictureDialog& dialog, bool is_turn) {
  dialog.is_turn = is_turn;
  fs::path name = typed_path(dialog.browser.typed);
  if (!name.has_filename()) return;
  name.replace_extension(is_turn ? ".webp" : ".png");
  if (name != dialog.browser.typed) set_text(dialog.browser, name.string());
}

void submit_picture(Session& session, const std::vector<const FolderEntry*>& shown) {
  PictureDialog& dialog = session.picture;
  FileBrowser& browser = dialog.browser;
  if (take_row(browser, shown)) return;
  const fs::path file = typed_file(browser);
  if (is_folder(file)) return go_to(browser, file);
  const std::string problem = problem_of(session, request_of(dialog, file));
  if (!problem.empty()) return refuse_text(browser, problem);
  dialog.waiting = file;
  dialog.is_shown = false;
  session.preferences.picture_folder = file.parent_path();
}

std::optional<PictureTask> begin_requested_picture(Session& session) {
  const auto file = std::exchange(session.picture.waiting, std::nullopt);
  if (!file) return std::nullopt;
  return begin_picture(session.document, session.view, request_of(session.picture, *file));
}

}  // namespace mesher::app
