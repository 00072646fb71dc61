#pragma once

#include <string>
#include <vector>

namespace mesher::test {

/// How the file system of a program under test misbehaves: what tests/support/file_faults does when
/// it is preloaded.
struct FileFaults {
  bool has_no_tmpfile = false;  ///< no unnamed files, as on FUSE
  int slow_us = 0;              ///< before each write to a file
  int signal = 0;               ///< sent to the program at its `at`-th write to a file
  std::string cut = {};         ///< a file that is cut to 100 bytes when the `at`-th file is mapped
  std::string change = {};      ///< a file whose first byte changes then
  int at = 1;
  std::string log = {};  ///< gets a line for each "fsync file", "fsync folder" and "rename"

  /// Returns the environment of a program that gets them.
  std::vector<std::string> environment() const;
};

}  // namespace mesher::test
