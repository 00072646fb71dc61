#pragma once

#include <cstdint>
#include <filesystem>

namespace mesher::io {

/// What tells whether a regular file was changed: its inode, size, and times of change. A file that
/// is not regular has no stamp, and never counts as changed.
class FileStamp {
 public:
  FileStamp() = default;
  /// Takes the stamp of an open file. File times have the resolution of the system's clock ticks, a
  /// few milliseconds. If a large file was changed in the present tick, waits for the next one, so
  /// that a later change shows.
  explicit FileStamp(int descriptor);

  std::uint64_t size() const { return size_; }
  /// Returns whether the file of this name still has this stamp.
  bool is_current(const std::filesystem::path& file) const;

 private:
  bool is_regular_ = false;
  std::uint64_t device_ = 0;
  std::uint64_t inode_ = 0;
  std::uint64_t size_ = 0;
  std::int64_t written_ns_ = 0;
  std::int64_t changed_ns_ = 0;
};

}  // namespace mesher::io
