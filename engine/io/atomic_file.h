#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

namespace mesher {

/// A file that appears whole or not at all: written without a name in the target's folder (where
/// the file system knows such files; otherwise under a temporary one), named and renamed by
/// `commit`. Destroyed without it, or killed, it leaves nothing behind, and whatever stood at the
/// target stays. A link is followed, an existing file's permissions are kept. Pipes cannot be
/// renamed over and are written directly; so is what is open already (`/dev/stdout`, `/dev/fd/3`).
class AtomicFile {
 public:
  /// Throws OutputError where the target is a directory or its folder cannot be written.
  explicit AtomicFile(const std::filesystem::path& target);
  /// Throws OutputError where it is plain, without opening anything, that the target cannot be
  /// written: for a word before long work rather than after it.
  static void check(const std::filesystem::path& target);
  ~AtomicFile();
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;

  /// Appends; nothing is buffered, so write in large pieces. Throws OutputError.
  void write(std::string_view bytes);
  /// The target as the caller spelt it, for messages.
  const std::string& name() const { return name_; }
  /// Bytes written so far.
  std::uint64_t size() const { return size_; }
  /// Closes the file and gives it its name. Throws OutputError; the temporary file is gone then.
  void commit();

 private:
  void open_temporary();
  void name_temporary();
  template <class Make>
  void try_names(Make make);
  void discard() noexcept;
  [[noreturn]] void fail(const char* action);

  std::string name_;
  std::filesystem::path target_;
  std::filesystem::path temporary_;  ///< empty while the file has no name
  bool is_direct_ = false;           ///< the target itself is written
  int descriptor_ = -1;
  std::uint64_t size_ = 0;
};

}  // namespace mesher
