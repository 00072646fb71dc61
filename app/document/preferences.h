#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace mesher::app {

/// What the program remembers from one run to the next.
struct Preferences {
  static constexpr std::size_t kMostRecent = 12;

  std::vector<std::filesystem::path> recent;  ///< opened files, absolute, the last one first
  std::filesystem::path open_folder;          ///< of the file that was opened last
  std::filesystem::path save_folder;          ///< of the file that was saved last
  std::string save_extension;                 ///< of that file, such as ".ply"
  std::filesystem::path picture_folder;       ///< of the last picture of the dialog
  bool shows_hidden_files = false;
  friend bool operator==(const Preferences&, const Preferences&) = default;
};

/// Puts a file that was opened in front of the recent ones.
void remember_opened(Preferences& preferences, const std::filesystem::path& file);
/// Remembers folder and format of a file that was saved.
void remember_saved(Preferences& preferences, const std::filesystem::path& file);

}  // namespace mesher::app
