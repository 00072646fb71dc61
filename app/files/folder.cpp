#include "app/files/folder.h"

#include <algorithm>
#include <cctype>
#include <fstream>

#include "app/files/paths.h"
#include "app/files/percent.h"
#include "engine/io/format.h"

namespace mesher::app {
namespace {

namespace fs = std::filesystem;

// Of a damaged or hostile file of bookmarks, no more is read.
constexpr std::size_t kMostBookmarks = 20;

char lower_letter(char c) {
  return static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
}

bool are_same_letters(char a, char b) {
  return lower_letter(a) == lower_letter(b);
}

bool contains(std::string_view text, std::string_view part) {
  // clang 14 cannot compile std::ranges::search of libstdc++ 12.
  const auto found =
      std::search(text.begin(), text.end(), part.begin(), part.end(), are_same_letters);
  return part.empty() || found != text.end();
}

bool begins(std::string_view text, std::string_view start) {
  return text.size() >= start.size() &&
         std::ranges::equal(text.substr(0, start.size()), start, are_same_letters);
}

bool is_less(std::string_view a, std::string_view b) {
  return std::ranges::lexicographical_compare(a, b, {}, lower_letter, lower_letter);
}

/// Returns whether a byte of UTF-8 is not the first one of its character.
bool continues_character(char byte) {
  return (static_cast<unsigned char>(byte) & 0xC0U) == 0x80U;
}

bool is_hidden(const FolderEntry& entry) {
  return entry.name.starts_with('.');
}

bool is_of(FileKind kind, const FolderEntry& entry) {
  if (entry.is_folder) return true;
  return kind == FileKind::models ? io::format_of(entry.name) != nullptr
                                  : is_png_name(entry.name) || is_webp_name(entry.name);
}

/// Returns -1, 0 or 1: how `a` compares with `b`, apart from their names.
int compare(const FolderEntry& a, const FolderEntry& b, FolderOrder order) {
  const auto sign = [](const auto& x, const auto& y) { return x < y ? -1 : int(y < x); };
  if (order == FolderOrder::size) return sign(a.bytes, b.bytes);
  return order == FolderOrder::modified ? sign(a.modified, b.modified) : 0;
}

void add_place(std::vector<Place>& places, const std::string& name, const fs::path& folder) {
  std::error_code ignored;
  if (folder.empty() || !fs::is_directory(folder, ignored)) return;
  const auto is_same = [&](const Place& place) { return place.folder == folder; };
  if (std::ranges::none_of(places, is_same)) places.push_back({name, folder});
}

// The lines of GTK's file are "file:///models/cars Name".
void add_bookmarks(std::vector<Place>& places, const fs::path& home) {
  constexpr std::string_view kScheme = "file://";
  std::ifstream file(home / ".config/gtk-3.0/bookmarks");
  std::string line;
  for (std::size_t i = 0; i < kMostBookmarks && std::getline(file, line); ++i) {
    if (!line.starts_with(kScheme)) continue;
    const std::size_t blank = line.find(' ');
    const fs::path folder =
        percent_decoded(line.substr(kScheme.size(), blank - std::min(blank, kScheme.size())));
    add_place(places,
              blank != std::string::npos ? line.substr(blank + 1) : folder.filename().string(),
              folder);
  }
}

void add_media(std::vector<Place>& places, const fs::path& folder) {
  std::error_code none;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, none))
    add_place(places, entry.path().filename().string(), entry.path());
}

}  // namespace

Folder read_folder(const fs::path& path) {
  Folder folder;
  folder.path = path;
  std::error_code error;
  fs::directory_iterator entries(path, error);
  for (; !error && entries != fs::directory_iterator(); entries.increment(error)) {
    if (folder.entries.size() == Folder::kMostEntries) {
      folder.is_whole = false;
      break;
    }
    std::error_code gone;
    FolderEntry entry{.name = entries->path().filename().string()};
    entry.is_folder = entries->is_directory(gone);
    if (!gone && !entry.is_folder && entries->is_regular_file(gone))
      entry.bytes = entries->file_size(gone);
    if (!gone) entry.modified = entries->last_write_time(gone);
    if (!gone) folder.entries.push_back(std::move(entry));
  }
  if (error) folder.problem = path.string() + ": " + error.message();
  return folder;
}

std::vector<const FolderEntry*> shown_entries(const Folder& folder, const FolderFilter& filter) {
  std::vector<const FolderEntry*> shown;
  for (const FolderEntry& entry : folder.entries) {
    const bool is_wanted = filter.shows_hidden || filter.part.starts_with('.') || !is_hidden(entry);
    if (is_wanted && (filter.shows_all_files || is_of(filter.kind, entry)) &&
        contains(entry.name, filter.part))
      shown.push_back(&entry);
  }
  std::ranges::sort(shown, [&](const FolderEntry* a, const FolderEntry* b) {
    if (a->is_folder != b->is_folder) return a->is_folder;
    if (const int sign = compare(*a, *b, filter.order); sign != 0)
      return filter.is_descending ? sign > 0 : sign < 0;
    const bool turns = filter.is_descending && filter.order == FolderOrder::name;
    if (is_less(a->name, b->name) || is_less(b->name, a->name))
      return turns ? is_less(b->name, a->name) : is_less(a->name, b->name);
    return a->name < b->name;
  });
  return shown;
}

std::vector<const FolderEntry*> beginning_with(const std::vector<const FolderEntry*>& entries,
                                               std::string_view start) {
  std::vector<const FolderEntry*> found;
  for (const FolderEntry* entry : entries) {
    if (begins(entry->name, start)) found.push_back(entry);
  }
  return found;
}

std::string common_start(const std::vector<const FolderEntry*>& entries) {
  const std::string& first = entries.front()->name;
  std::size_t common = first.size();
  for (const FolderEntry* entry : entries) {
    const std::string& name = entry->name;
    const auto ends =
        std::mismatch(first.begin(), first.end(), name.begin(), name.end(), are_same_letters);
    common = std::min(common, static_cast<std::size_t>(ends.first - first.begin()));
  }
  while (common > 0 && common < first.size() && continues_character(first[common]))
    --common;
  return first.substr(0, common);
}

std::vector<Place> places() {
  std::vector<Place> all;
  const fs::path home = home_folder();
  add_place(all, "Home", home);
  if (!home.empty()) {
    for (const char* name : {"Desktop", "Documents", "Downloads"})
      add_place(all, name, home / name);
  }
  std::error_code ignored;
  add_place(all, "Working folder", fs::current_path(ignored));
  add_place(all, "Samples", samples_folder());
  if (!home.empty()) {
    add_bookmarks(all, home);
    add_media(all, fs::path("/media") / home.filename());
    add_media(all, fs::path("/run/media") / home.filename());
  }
  add_place(all, "File system", "/");
  return all;
}

}  // namespace mesher::app
