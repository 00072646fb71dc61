#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

#include "engine/core/array.h"
#include "engine/core/error.h"
#include "engine/core/progress.h"
#include "engine/io/cut_mapping.h"
#include "engine/io/file_stamp.h"

namespace mesher::io {

/// Thrown for an input that another program changed while it was read. What such a file lacks
/// cannot be made up for, so nobody turns this into a warning.
class InputChanged : public InputError {
 public:
  using InputError::InputError;
};

/// How the bytes of a regular file are kept.
enum class Keep : std::uint8_t {
  mapped,  ///< in the file: quick, and needs no memory
  /// In memory: later changes of the file do no harm. For files that stay open long.
  copied,
};

/// A whole file, read-only, as one span of bytes.
///
/// A regular file is memory-mapped, unless it is to be copied. A pipe is read block by block (so
/// `/dev/stdin` works). Sizes are 64-bit. If another program changes a regular file while it is
/// read, the bytes are neither the old file nor the new one: the reader calls check_unchanged
/// when it is done. If the file is cut short while it is mapped, zeros are read beyond its new end.
/// This needs survive_cut_mappings (engine/io/cut_mapping.h): without it, files are copied.
class MappedFile {
 public:
  /// Number of zero bytes that may be read past the end. Scanners that look a word ahead, or for
  /// the character that ends a number, need no bounds check.
  static constexpr std::size_t kPadding = 64;

  /// Throws InputError if the file is missing, unreadable, a directory or a device; Cancelled if
  /// `progress` is canceled while a pipe has no data.
  explicit MappedFile(const std::filesystem::path& file, Progress* progress = nullptr,
                      Keep keep = Keep::mapped);
  /// Bytes that are in memory already, such as a part of another file. `name`: for messages.
  MappedFile(std::string name, std::string_view bytes);
  ~MappedFile();
  MappedFile(const MappedFile&) = delete;
  MappedFile& operator=(const MappedFile&) = delete;

  const std::string& name() const { return name_; }
  const char* begin() const { return data_; }
  const char* end() const { return data_ + size_; }
  std::size_t size() const { return size_; }
  std::string_view bytes() const { return {data_, size_}; }
  Keep keep() const { return keep_; }

  /// Throws InputChanged if another program changed the file, or put another one in its place,
  /// since it was opened. A copied file was checked when it was. O(1).
  void check_unchanged() const;

  /// Returns the number of the line that contains `where`, counted from 1. A line ends with its
  /// newline. O(size); meant for error messages. Pre: begin() <= where <= end().
  std::uint64_t line_of(const char* where) const;

 private:
  bool map(int descriptor, std::size_t size);
  void read_blocks(int descriptor, std::size_t first, Progress* progress);
  [[noreturn]] void fail(const char* action) const;

  std::string name_;
  FileStamp stamp_;
  CutWatch watch_;
  Keep keep_ = Keep::mapped;
  const char* data_ = nullptr;
  std::size_t size_ = 0;
  std::size_t mapped_bytes_ = 0;  ///< 0: the bytes are in copy_
  Array<char> copy_;
};

/// Calls `read`, and returns what it returns unless another program changed the file meanwhile:
/// throws InputChanged then, which is also the true reason for whatever `read` found wrong.
/// `file`: a MappedFile, or what reads from some.
template <class File, class Read>
auto read_unchanged(const File& file, Read read) {
  try {
    auto result = read();
    file.check_unchanged();
    return result;
  } catch (const InputError&) {
    file.check_unchanged();
    throw;
  }
}

}  // namespace mesher::io
