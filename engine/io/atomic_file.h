#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

struct stat;

namespace mesher::io {

/// When a file has to be on the disk, and not only in the memory of the system.
enum class Flush {
  later,  ///< when the system likes: a power failure soon after may lose it
  now,    ///< before `commit` returns
};

/// Writes a file that appears whole or not at all.
///
/// The data goes to an unnamed file in the target's folder, or to a temporary file where the file
/// system does not support unnamed ones. `commit` gives that file the target's name. Destruction
/// without `commit` leaves nothing behind and does not change an existing target, nor does a signal
/// (engine/io/temporary_files.h). A process that is killed at once does not change the target
/// either; if it leaves a temporary file, the next write into that folder removes it.
///
/// What becomes of an existing file:
/// - Symbolic links are followed, also where they lead to no file yet.
/// - The permissions stay. So does the owner, if the process may give files away; without the
/// owner,
///   set-user-ID and set-group-ID bits are not kept. Access control lists are not kept.
/// - Other hard links to the file keep the old content.
/// - Pipes and files that are open already (`/dev/stdout`, `/dev/fd/3`) cannot be replaced by a
///   rename and are written directly.
class AtomicFile {
 public:
  /// Throws OutputError if the target is a directory or its folder cannot be written.
  explicit AtomicFile(const std::filesystem::path& target);
  /// Throws OutputError if the target obviously cannot be written. Opens nothing. Call it before
  /// long work to fail early.
  static void check(const std::filesystem::path& target);
  ~AtomicFile();
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;

  /// Appends `bytes`. Nothing is buffered, so write large pieces. Throws OutputError.
  void write(std::string_view bytes);
  /// Returns the target as the caller spelled it, for messages.
  const std::string& name() const { return name_; }
  /// Bytes written so far.
  std::uint64_t size() const { return size_; }
  /// Adds a file that belongs to this one, by its path from this one's folder, and returns it.
  /// Missing folders are made. `commit` gives these files their names before this one has its own,
  /// so that whatever refers to them finds them. Throws OutputError.
  AtomicFile& add_side(const std::filesystem::path& relative);
  /// Gives the file its name. With Flush::now, a power failure leaves the old file or the new one.
  /// Throws OutputError, and then the temporary file has been removed. Files of add_side get no
  /// name unless the data of all files is written.
  void commit(Flush flush = Flush::later);
  /// As `commit`, for files of which none may appear unless the data of all is written.
  static void commit_all(std::span<const std::unique_ptr<AtomicFile>> files,
                         Flush flush = Flush::later);

 private:
  static void commit_all(std::span<AtomicFile* const> files, Flush flush);
  void open_target(const std::filesystem::path& target);
  void open_temporary();
  bool make_temporary();
  void keep_owner_and_mode(const struct stat& old) const noexcept;
  void finish_data(Flush flush);
  void name_temporary();
  void flush_bytes();
  void take_name();
  void discard() noexcept;
  [[noreturn]] void fail_without_name();
  [[noreturn]] void fail(const char* action);

  std::string name_;
  std::filesystem::path target_;
  std::filesystem::path temporary_;  ///< empty while the file has no name
  bool is_direct_ = false;           ///< writes to the target itself
  int descriptor_ = -1;              ///< open until the file has its name, because of its lock
  std::uint64_t size_ = 0;
  std::vector<std::unique_ptr<AtomicFile>> sides_;
  std::vector<std::filesystem::path> made_folders_;  ///< removed unless it comes to a commit
};

}  // namespace mesher::io
