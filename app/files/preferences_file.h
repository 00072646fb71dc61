#pragma once

#include <filesystem>
#include <string>

#include "app/document/preferences.h"

namespace mesher::app {

/// The file that keeps preferences: settings.json, in a folder of its own. Neither a damaged file
/// nor a folder that cannot be written is an error: preferences are then not kept. After a full
/// disk, the next change is kept again.
class PreferencesFile {
 public:
  static constexpr int kVersion = 1;
  /// Larger files are not read.
  static constexpr std::uintmax_t kMostBytes = std::uintmax_t{1} << 20;

  /// `folder`: created with the first change; empty: nothing is read or written.
  explicit PreferencesFile(std::filesystem::path folder);

  /// Returns what the file holds, or defaults. A damaged file is renamed, and one of a later
  /// version of the program stays as it is; `take_remark` says so.
  Preferences read();
  /// Writes the preferences if they have changed since the last call. Recent files that other
  /// running programs have added meanwhile are kept, after those of this one.
  void write(const Preferences& preferences);
  /// Returns what a person has to know about the file, once; empty: nothing.
  std::string take_remark();

 private:
  Preferences parse();
  void store(Preferences preferences);

  std::filesystem::path folder_;
  std::filesystem::path file_;
  Preferences known_;  ///< as last read or written
  bool can_write_ = true;
  bool is_failing_ = false;  ///< the last write failed
  std::string remark_;
};

}  // namespace mesher::app
