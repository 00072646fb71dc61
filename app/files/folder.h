#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "app/document/file_browser.h"

namespace mesher::app {

/// A file or folder in a folder.
struct FolderEntry {
  std::string name;
  bool is_folder = false;  ///< also a link to a folder
  std::uint64_t bytes = 0;
  std::filesystem::file_time_type modified{};
};

/// What is in a folder.
struct Folder {
  /// Of larger folders, only so many entries are read, in the order of the file system.
  static constexpr std::size_t kMostEntries = 20'000;

  std::filesystem::path path;
  std::vector<FolderEntry> entries;
  bool is_whole = true;  ///< every entry was read
  std::string problem;   ///< why it cannot be read; empty: it could
};

/// Reads a folder. Entries that vanish or cannot be examined are left out. O(entries).
Folder read_folder(const std::filesystem::path& path);

/// Returns the entries that a filter lets through: folders first; equal ones by name. The pointers
/// are into the folder. O(n log n).
std::vector<const FolderEntry*> shown_entries(const Folder& folder, const FolderFilter& filter);

/// Returns the entries whose names begin with `start`, in upper or lower case.
std::vector<const FolderEntry*> beginning_with(const std::vector<const FolderEntry*>& entries,
                                               std::string_view start);
/// Returns how all names begin, in upper or lower case. Pre: there is an entry.
std::string common_start(const std::vector<const FolderEntry*>& entries);

/// A folder that is often wanted.
struct Place {
  std::string name;
  std::filesystem::path folder;
};

/// Returns the places that exist: home and its usual folders, the working folder, the models that
/// come with the program, the desktop's bookmarks, removable media, the root.
std::vector<Place> places();

}  // namespace mesher::app
