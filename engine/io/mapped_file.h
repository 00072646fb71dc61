#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

#include "engine/core/array.h"
#include "engine/core/progress.h"

namespace mesher::io {

/// How the bytes of a regular file are kept.
enum class Keep : std::uint8_t {
  mapped,  ///< in the file: quick, and needs no memory
  copied,  ///< in memory: later changes of the file do no harm. For files that stay open long.
};

/// A whole file, read-only, as one span of bytes.
///
/// A regular file is memory-mapped, unless it is to be copied. A pipe is read block by block (so
/// `/dev/stdin` works). Sizes are 64-bit. If another program truncates a regular file while it is
/// mapped, this program dies; that is the price of not copying the file.
class MappedFile {
 public:
  /// Number of zero bytes that may be read past the end. Scanners that look a word ahead, or for
  /// the character that ends a number, need no bounds check.
  static constexpr std::size_t kPadding = 64;

  /// Throws InputError if the file is missing, unreadable, a directory or a device; Cancelled if
  /// `progress` is canceled while a pipe has no data.
  explicit MappedFile(const std::filesystem::path& file, Progress* progress = nullptr,
                      Keep keep = Keep::mapped);
  ~MappedFile();
  MappedFile(const MappedFile&) = delete;
  MappedFile& operator=(const MappedFile&) = delete;

  const std::string& name() const { return name_; }
  const char* begin() const { return data_; }
  const char* end() const { return data_ + size_; }
  std::size_t size() const { return size_; }
  std::string_view bytes() const { return {data_, size_}; }
  Keep keep() const { return keep_; }

  /// Returns the number of the line that contains `where`, counted from 1. A line ends with its
  /// newline. O(size); meant for error messages. Pre: begin() <= where <= end().
  std::uint64_t line_of(const char* where) const;

 private:
  void map(int descriptor, std::size_t size);
  void read_blocks(int descriptor, Progress* progress);
  [[noreturn]] void fail(const char* action) const;

  std::string name_;
  Keep keep_ = Keep::mapped;
  const char* data_ = nullptr;
  std::size_t size_ = 0;
  std::size_t mapped_bytes_ = 0;  ///< 0: the bytes are in copy_
  Array<char> copy_;
};

}  // namespace mesher::io
