#include "engine/io/atomic_file.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <set>
#include <string>
#include <system_error>
#include <utility>

#include "engine/core/error.h"
#include "engine/core/progress.h"
#include "engine/io/extension.h"
#include "engine/io/temporary_files.h"

namespace mesher::io {
namespace {

/// write(2) writes at most 2 GB. Smaller pieces also let the page cache drain steadily.
constexpr std::size_t kLargestWrite = std::size_t{1} << 26;

/// Returns whether the descriptor is writable. Sets errno if not.
bool is_writable(int descriptor) {
  const int flags = ::fcntl(descriptor, F_GETFL);
  if (flags >= 0 && (flags & O_ACCMODE) == O_RDONLY) errno = EBADF;
  return flags >= 0 && (flags & O_ACCMODE) != O_RDONLY;
}

std::filesystem::path folder_of(const std::filesystem::path& file) {
  return file.has_parent_path() ? file.parent_path() : std::filesystem::path(".");
}

/// Returns what a chain of symbolic links leads to, even if nothing is there.
std::filesystem::path behind_links(const std::filesystem::path& target) {
  constexpr int kMostLinks = 40;  // as the kernel
  std::filesystem::path file = target;
  for (int link = 0; link < kMostLinks; ++link) {
    std::error_code error;
    const std::filesystem::path next = std::filesystem::read_symlink(file, error);
    if (error) return file;
    file = file.parent_path() / next;
  }
  throw OutputError(target.string(), "cannot write: " + std::generic_category().message(ELOOP));
}

/// Returns whether the folder may get a file of this name in place of the one that has it, if any.
/// Sets errno if not.
bool may_take_name(const std::filesystem::path& folder, const struct stat* old) {
  if (::access(folder.c_str(), W_OK | X_OK) != 0) return false;
  struct stat status = {};
  if (::stat(folder.c_str(), &status) != 0) return false;
  errno = ENOTDIR;
  if (!S_ISDIR(status.st_mode)) return false;
  // Of a folder such as /tmp, everybody may replace only what is his.
  const bool is_sticky = (status.st_mode & S_ISVTX) != 0 && ::geteuid() != 0;
  errno = EPERM;
  return old == nullptr || !is_sticky || old->st_uid == ::geteuid() || status.st_uid == ::geteuid();
}

void flush_folder(const std::filesystem::path& folder) noexcept {
  const int descriptor = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (descriptor < 0) return;  // of a folder that cannot be read, the name follows later
  static_cast<void>(::fsync(descriptor));
  ::close(descriptor);
}

void wait_for_room(int descriptor) {
  constexpr int kBetweenChecks_ms = 50;
  check_cancelled(nullptr);
  pollfd writable{descriptor, POLLOUT, 0};
  ::poll(&writable, 1, kBetweenChecks_ms);
}

}  // namespace

AtomicFile::AtomicFile(const std::filesystem::path& target)
    : name_(target.string()), target_(target) {
  const int named = descriptor_of(target);
  if (named < 0) {
    open_target(target);
  } else {
    if (is_writable(named)) descriptor_ = ::fcntl(named, F_DUPFD_CLOEXEC, 0);
    if (descriptor_ < 0) fail("cannot write");
    is_direct_ = true;
  }
}

void AtomicFile::open_target(const std::filesystem::path& target) {
  struct stat old = {};
  const bool exists = ::stat(target.c_str(), &old) == 0;
  if (exists && S_ISDIR(old.st_mode)) throw OutputError(name_, "is a directory");
  if (exists && ::access(target.c_str(), W_OK) != 0) fail("cannot write");
  if (exists && !S_ISREG(old.st_mode)) {
    descriptor_ = ::open(target.c_str(), O_WRONLY | O_CLOEXEC);
    if (descriptor_ < 0) fail("cannot write");
    is_direct_ = true;
    return;
  }
  target_ = behind_links(target);
  sweep_temporaries(folder_of(target_));
  open_temporary();
  if (exists) keep_owner_and_mode(old);
}

void AtomicFile::check(const std::filesystem::path& target) {
  const auto refuse = [&](const std::string& reason) {
    throw OutputError(target.string(), reason);
  };
  const auto refuse_as_errno = [&] {
    refuse("cannot write: " + std::generic_category().message(errno));
  };
  if (const int named = descriptor_of(target); named >= 0) {
    if (!is_writable(named)) refuse_as_errno();
    return;
  }
  struct stat old = {};
  const bool exists = ::stat(target.c_str(), &old) == 0;
  if (exists && S_ISDIR(old.st_mode)) refuse("is a directory");
  if (exists && ::access(target.c_str(), W_OK) != 0) refuse_as_errno();
  if (exists && !S_ISREG(old.st_mode)) return;
  const std::filesystem::path folder = folder_of(behind_links(target));
  if (may_take_name(folder, exists ? &old : nullptr)) return;
  const std::string reason = std::generic_category().message(errno);
  if (exists) refuse("cannot be replaced in its folder: " + reason);
  refuse("cannot write: " + reason);
}

AtomicFile::~AtomicFile() {
  discard();
}

void AtomicFile::open_temporary() {
  descriptor_ = ::open(folder_of(target_).c_str(), O_WRONLY | O_TMPFILE | O_CLOEXEC, 0666);
  if (descriptor_ >= 0) {
    static_cast<void>(lock_temporary(descriptor_));
    return;
  }
  // Not every file system supports unnamed files. If the cause is another, this reports it.
  constexpr int kMostTries = 100;  // another process may remove the file before it is locked
  for (int i = 0; i < kMostTries; ++i) {
    if (make_temporary()) return;
  }
  fail("cannot write");
}

/// Returns false if another process has taken the file for a stale one.
bool AtomicFile::make_temporary() {
  const NoSignals no_signals;
  temporary_ = target_.parent_path() / temporary_name();
  list_temporary(temporary_);
  descriptor_ = ::open(temporary_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
  if (descriptor_ < 0) fail_without_name();
  struct stat status = {};
  if (lock_temporary(descriptor_) && ::fstat(descriptor_, &status) == 0 && status.st_nlink > 0)
    return true;
  discard();
  return false;
}

void AtomicFile::keep_owner_and_mode(const struct stat& old) const noexcept {
  // Some file systems support neither; the file is valid without them.
  struct stat own = {};
  static_cast<void>(::fstat(descriptor_, &own));
  mode_t mode = old.st_mode & 07777U;
  const bool is_same = own.st_uid == old.st_uid && own.st_gid == old.st_gid;
  if (!is_same && ::fchown(descriptor_, old.st_uid, old.st_gid) != 0) mode &= 0777U;
  static_cast<void>(::fchmod(descriptor_, mode));
}

void AtomicFile::write(std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t done = ::write(descriptor_, bytes.data(), std::min(bytes.size(), kLargestWrite));
    if (done < 0 && errno == EINTR) continue;
    if (done < 0 && errno == EAGAIN) {  // a pipe whose other end made it non-blocking
      wait_for_room(descriptor_);
      continue;
    }
    if (done < 0) fail("cannot write");
    bytes.remove_prefix(static_cast<std::size_t>(done));
    size_ += static_cast<std::uint64_t>(done);
  }
}

/// The bytes have to be on the disk before the name is: otherwise, a power failure in between
/// leaves an empty file in place of the old one.
void AtomicFile::flush_bytes() {
  // Some file systems cannot flush, and neither can pipes; the file is valid without it.
  if (::fsync(descriptor_) != 0 && errno != EINVAL && errno != ENOSYS) fail("cannot write");
}

AtomicFile& AtomicFile::add_side(const std::filesystem::path& relative) {
  const std::filesystem::path side = std::filesystem::path(name_).parent_path() / relative;
  std::vector<std::filesystem::path> missing;
  std::error_code error;
  for (std::filesystem::path folder = side.parent_path();
       !folder.empty() && !std::filesystem::exists(folder, error); folder = folder.parent_path()) {
    missing.push_back(folder);
  }
  made_folders_.reserve(made_folders_.size() + missing.size());
  for (auto folder = missing.rbegin(); folder != missing.rend(); ++folder) {
    const NoSignals no_signals;
    list_temporary(*folder);
    if (!std::filesystem::create_directory(*folder, error) && error) {
      unlist_temporary(*folder);
      throw OutputError(folder->string(), "cannot make the folder: " + error.message());
    }
    made_folders_.push_back(*folder);
  }
  return *sides_.emplace_back(std::make_unique<AtomicFile>(side));
}

void AtomicFile::commit(Flush flush) {
  AtomicFile* const file = this;
  commit_all({&file, 1}, flush);
}

void AtomicFile::commit_all(std::span<const std::unique_ptr<AtomicFile>> files, Flush flush) {
  std::vector<AtomicFile*> all;
  for (const auto& file : files)
    all.push_back(file.get());
  commit_all(all, flush);
}

void AtomicFile::commit_all(std::span<AtomicFile* const> files, Flush flush) {
  for (AtomicFile* file : files) {
    for (const auto& side : file->sides_)
      side->finish_data(flush);
    file->finish_data(flush);
  }
  std::set<std::filesystem::path> folders;
  {
    const NoSignals no_signals;  // none comes between the names of files that belong together
    for (AtomicFile* file : files) {
      for (const auto& side : file->sides_) {
        side->take_name();
        folders.insert(folder_of(side->target_));
      }
      for (const auto& folder : file->made_folders_) {
        unlist_temporary(folder);
        folders.insert(folder_of(folder));
      }
      file->made_folders_.clear();
      file->take_name();
      if (!file->is_direct_) folders.insert(folder_of(file->target_));
    }
  }
  if (flush == Flush::later) return;
  for (const auto& folder : folders)
    flush_folder(folder);
}

/// Brings all data to the temporary file, which has a name then. What can fail mostly fails here.
void AtomicFile::finish_data(Flush flush) {
  if (flush == Flush::now) flush_bytes();
  if (!is_direct_ && temporary_.empty()) name_temporary();
  // Network file systems report a full disk only when a descriptor is closed.
  const int copy = ::fcntl(descriptor_, F_DUPFD_CLOEXEC, 0);
  if (copy < 0 || ::close(copy) != 0) fail("cannot write");
}

void AtomicFile::name_temporary() {
  const NoSignals no_signals;
  const std::string unnamed = "/proc/self/fd/" + std::to_string(descriptor_);
  // The target's name is not part of it, because that may already have the maximum length.
  temporary_ = target_.parent_path() / temporary_name();
  list_temporary(temporary_);
  if (::linkat(AT_FDCWD, unnamed.c_str(), AT_FDCWD, temporary_.c_str(), AT_SYMLINK_FOLLOW) != 0)
    fail_without_name();
}

void AtomicFile::take_name() {
  if (!is_direct_) {
    if (::rename(temporary_.c_str(), target_.c_str()) != 0) fail("cannot write");
    unlist_temporary(temporary_);
    temporary_.clear();
  }
  ::close(std::exchange(descriptor_, -1));
}

void AtomicFile::discard() noexcept {
  const NoSignals no_signals;
  if (!temporary_.empty()) {
    ::unlink(temporary_.c_str());
    unlist_temporary(temporary_);
    temporary_.clear();
  }
  if (descriptor_ >= 0) ::close(std::exchange(descriptor_, -1));
  sides_.clear();
  std::error_code error;  // a folder that is used by now stays
  for (; !made_folders_.empty(); made_folders_.pop_back()) {
    std::filesystem::remove(made_folders_.back(), error);
    unlist_temporary(made_folders_.back());
  }
}

/// The temporary name is not ours: whatever has it stays.
void AtomicFile::fail_without_name() {
  const int error = errno;
  unlist_temporary(temporary_);
  temporary_.clear();
  errno = error;
  fail("cannot write");
}

void AtomicFile::fail(const char* action) {
  const int error = errno;
  discard();
  throw OutputError(name_, std::string(action) + ": " + std::generic_category().message(error));
}

}  // namespace mesher::io
