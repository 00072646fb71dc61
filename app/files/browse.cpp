#include "app/files/browse.h"

#include <algorithm>

#include "app/files/paths.h"
#include "engine/core/text.h"

namespace mesher::app {
namespace {

namespace fs = std::filesystem;

/// Returns "/a/b" for "/a/b/".
fs::path without_slash(const fs::path& folder) {
  return folder.has_filename() || !folder.has_relative_path() ? folder : folder.parent_path();
}

/// The position behind the last slash.
std::size_t name_begin(const std::string& typed) {
  const std::size_t slash = typed.rfind('/');
  return slash == std::string::npos ? 0 : slash + 1;
}

/// The folder and the last part of what is typed; a path that ends in a slash has an empty one.
struct Typed {
  fs::path folder;
  std::string name;
};
Typed split(const FileBrowser& browser) {
  const fs::path path = browser.folder / typed_path(browser.typed);
  if (path == browser.folder) return {browser.folder, ""};
  return {path.parent_path(), path.filename().string()};
}

}  // namespace

fs::path shown_folder(const FileBrowser& browser) {
  return without_slash(split(browser).folder.lexically_normal());
}

fs::path typed_file(const FileBrowser& browser) {
  const fs::path typed = typed_path(browser.typed);
  return typed.empty() ? fs::path() : (browser.folder / typed).lexically_normal();
}

void follow_text(FileBrowser& browser) {
  browser.filter.part = browser.searches ? split(browser).name : "";
  browser.row.reset();
  browser.problem.clear();
}

void refuse_text(FileBrowser& browser, const std::string& problem) {
  set_text(browser, std::string(browser.typed));
  browser.problem = problem;
}

void set_text(FileBrowser& browser, const std::string& text) {
  browser.typed = text;
  browser.problem.clear();
  ++browser.texts_set;
}

void go_to(FileBrowser& browser, const fs::path& folder) {
  std::error_code failed;
  const fs::path whole = fs::absolute(folder, failed).lexically_normal();
  browser.folder = failed ? folder : without_slash(whole);
  set_text(browser, "");
  follow_text(browser);
}

void choose(FileBrowser& browser, const FolderEntry& entry) {
  const fs::path folder = shown_folder(browser);
  if (entry.is_folder) return go_to(browser, folder / entry.name);
  browser.folder = folder;
  set_text(browser, entry.name);
}

void move_row(FileBrowser& browser, int rows, std::size_t count) {
  if (count == 0) return;
  const int first = rows > 0 ? -1 : 0;
  browser.row = std::clamp(browser.row.value_or(first) + rows, 0, static_cast<int>(count) - 1);
}

std::string completed_text(const std::string& typed, const std::vector<const FolderEntry*>& shown) {
  const std::size_t begin = name_begin(typed);
  std::vector<const FolderEntry*> matches = beginning_with(shown, typed.substr(begin));
  if (matches.empty()) return typed;
  const bool is_folder = matches.size() == 1 && matches.front()->is_folder;
  return typed.substr(0, begin) + common_start(matches) + (is_folder ? "/" : "");
}

bool take_row(FileBrowser& browser, const std::vector<const FolderEntry*>& shown) {
  if (!browser.row || static_cast<std::size_t>(*browser.row) >= shown.size()) return false;
  const FolderEntry entry = *shown[static_cast<std::size_t>(*browser.row)];
  choose(browser, entry);
  return entry.is_folder;
}

std::string overwrite_question(fs::path& asked, const fs::path& file) {
  if (!is_there(file) || asked == file) return "";
  asked = file;
  return file.filename().string() + " already exists; press Enter again to overwrite it";
}

std::optional<fs::path> submit(FileBrowser& browser, const std::vector<const FolderEntry*>& shown) {
  browser.problem.clear();
  if (take_row(browser, shown)) return std::nullopt;
  const fs::path file = typed_file(browser);
  if (file.empty()) return std::nullopt;
  if (is_folder(file)) {
    go_to(browser, file);
    return std::nullopt;
  }
  if (is_there(file)) return file;
  const fs::path sample = find_model(typed_path(browser.typed).string());
  if (is_there(sample)) return sample;
  if (shown.size() == 1 && !shown.front()->is_folder)
    return shown_folder(browser) / shown.front()->name;
  refuse_text(browser, shown.empty() ? "there is no file " + file.string()
                                     : count_text(std::int64_t(shown.size()), "name") +
                                           " match; choose one with the arrow keys or the mouse");
  return std::nullopt;
}

}  // namespace mesher::app
