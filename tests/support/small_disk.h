#pragma once

#include <sys/types.h>

#include <cstddef>
#include <filesystem>

#include "tests/support/temp_folder.h"

namespace mesher::test {

/// A file system of a few pages, which is really full when it is full. It is mounted in a namespace
/// of its own, so that it needs no rights, and is reached from any process of the user below
/// /proc.
class SmallDisk {
 public:
  /// Throws std::runtime_error with the reason if the system refuses to mount it, as some
  /// containers do: a test of full disks must not pass without one.
  explicit SmallDisk(std::size_t bytes = std::size_t{1} << 16);
  ~SmallDisk();
  SmallDisk(const SmallDisk&) = delete;
  SmallDisk& operator=(const SmallDisk&) = delete;

  const std::filesystem::path& path() const { return path_; }
  std::filesystem::path operator/(const std::filesystem::path& name) const { return path_ / name; }
  /// Takes all the space that is left.
  void fill() const;
  /// Gives it back.
  void make_room() const;
  /// Returns the number of files, without what fills the disk.
  std::size_t count_files() const;

 private:
  TempFolder folder_;
  pid_t keeper_ = -1;     ///< the process in whose namespace it is mounted
  int keeper_pipe_ = -1;  ///< the keeper ends when this is closed
  std::filesystem::path path_;
};

}  // namespace mesher::test
