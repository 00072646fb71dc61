#include "engine/io/atomic_file.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <charconv>
#include <string>
#include <system_error>

#include "engine/core/error.h"
#include "engine/core/progress.h"

namespace mesher::io {
namespace {

/// write(2) writes at most 2 GB. Smaller pieces also let the page cache drain steadily.
constexpr std::size_t kLargestWrite = std::size_t{1} << 26;

/// Returns the number of the process's own descriptor that `target` names (/dev/stdout, /dev/fd/3),
/// or -1. The file behind it must not be replaced: with a shell's `>>`, its old content would be
/// lost.
int descriptor_named(const std::filesystem::path& target) {
  if (target == "/dev/stdout") return STDOUT_FILENO;
  if (target == "/dev/stderr") return STDERR_FILENO;
  if (target.parent_path() != "/dev/fd" && target.parent_path() != "/proc/self/fd") return -1;
  const std::string number = target.filename().string();
  int descriptor = -1;
  const auto [end, error] =
      std::from_chars(number.data(), number.data() + number.size(), descriptor);
  return error == std::errc() && end == number.data() + number.size() ? descriptor : -1;
}

/// Returns whether the descriptor is writable. Sets errno if not.
bool is_writable(int descriptor) {
  const int flags = ::fcntl(descriptor, F_GETFL);
  if (flags >= 0 && (flags & O_ACCMODE) == O_RDONLY) errno = EBADF;
  return flags >= 0 && (flags & O_ACCMODE) != O_RDONLY;
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
  if (const int named = descriptor_named(target); named >= 0) {
    if (is_writable(named)) descriptor_ = ::fcntl(named, F_DUPFD_CLOEXEC, 0);
    if (descriptor_ < 0) fail("cannot write");
    is_direct_ = true;
    return;
  }
  struct stat status = {};
  const bool exists = ::stat(target.c_str(), &status) == 0;
  if (exists && S_ISDIR(status.st_mode)) throw OutputError(name_, "is a directory");
  if (exists && ::access(target.c_str(), W_OK) != 0) fail("cannot write");
  if (exists && !S_ISREG(status.st_mode)) {
    descriptor_ = ::open(target.c_str(), O_WRONLY | O_CLOEXEC);
    if (descriptor_ < 0) fail("cannot write");
    is_direct_ = true;
    return;
  }
  if (exists && std::filesystem::is_symlink(target)) target_ = std::filesystem::canonical(target);
  open_temporary();
  // Some file systems do not support permissions; the file is valid without them.
  if (exists) static_cast<void>(::fchmod(descriptor_, status.st_mode & 07777));
}

void AtomicFile::check(const std::filesystem::path& target) {
  const auto refuse = [&](const std::string& reason) {
    throw OutputError(target.string(), reason);
  };
  if (const int named = descriptor_named(target); named >= 0) {
    if (!is_writable(named)) refuse("cannot write: " + std::generic_category().message(errno));
    return;
  }
  const std::filesystem::path folder = target.has_parent_path() ? target.parent_path() : ".";
  struct stat status = {};
  const bool exists = ::stat(target.c_str(), &status) == 0;
  if (exists && S_ISDIR(status.st_mode)) refuse("is a directory");
  const bool is_denied = ::access(exists ? target.c_str() : folder.c_str(), W_OK) != 0;
  if (is_denied) refuse("cannot write: " + std::generic_category().message(errno));
  if (!exists && !std::filesystem::is_directory(folder)) {
    refuse("cannot write: " + std::generic_category().message(ENOTDIR));
  }
}

AtomicFile::~AtomicFile() {
  discard();
}

void AtomicFile::open_temporary() {
  const std::filesystem::path folder = target_.has_parent_path() ? target_.parent_path() : ".";
  descriptor_ = ::open(folder.c_str(), O_WRONLY | O_TMPFILE | O_CLOEXEC, 0666);
  if (descriptor_ >= 0) return;
  // Not every file system supports unnamed files. If the cause is another, the second attempt
  // reports it.
  try_names([this] {
    descriptor_ = ::open(temporary_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    return descriptor_ >= 0;
  });
}

void AtomicFile::name_temporary() {
  const std::string unnamed = "/proc/self/fd/" + std::to_string(descriptor_);
  try_names([&] {
    return ::linkat(AT_FDCWD, unnamed.c_str(), AT_FDCWD, temporary_.c_str(), AT_SYMLINK_FOLLOW) ==
           0;
  });
}

/// Calls `make` with temporary names until it succeeds with a name that is not taken.
template <class Make>
void AtomicFile::try_names(Make make) {
  static std::atomic<unsigned> counter{0};
  for (int attempt = 0; attempt < 100; ++attempt) {
    // The target's name is not reused here, because it may already have the maximum length.
    temporary_ = target_.parent_path() / (".mesher-" + std::to_string(::getpid()) + "-" +
                                          std::to_string(counter++) + ".tmp");
    if (make()) return;
    if (errno != EEXIST) break;
  }
  temporary_.clear();
  fail("cannot write");
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
  // Some file systems cannot flush, and the file is valid without it.
  if (::fsync(descriptor_) != 0 && errno != EINVAL && errno != ENOSYS) fail("cannot write");
}

void AtomicFile::flush_name() const noexcept {
  const std::filesystem::path folder = target_.has_parent_path() ? target_.parent_path() : ".";
  const int descriptor = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (descriptor < 0) return;  // of a folder that cannot be read, the name follows later
  static_cast<void>(::fsync(descriptor));
  ::close(descriptor);
}

AtomicFile& AtomicFile::add_side(const std::filesystem::path& relative) {
  const std::filesystem::path side = std::filesystem::path(name_).parent_path() / relative;
  std::vector<std::filesystem::path> missing;
  std::error_code error;
  for (std::filesystem::path folder = side.parent_path();
       !folder.empty() && !std::filesystem::exists(folder, error); folder = folder.parent_path()) {
    missing.push_back(folder);
  }
  for (auto folder = missing.rbegin(); folder != missing.rend(); ++folder) {
    if (!std::filesystem::create_directory(*folder, error) && error)
      throw OutputError(folder->string(), "cannot make the folder: " + error.message());
    made_folders_.push_back(*folder);
  }
  return *sides_.emplace_back(std::make_unique<AtomicFile>(side));
}

void AtomicFile::commit(Flush flush) {
  for (const auto& side : sides_)
    side->finish_data(flush);
  finish_data(flush);
  for (const auto& side : sides_)
    side->take_name(flush);
  made_folders_.clear();
  take_name(flush);
}

/// Brings all data to the temporary file, which has a name then. What can fail mostly fails here.
void AtomicFile::finish_data(Flush flush) {
  if (flush == Flush::now && !is_direct_) flush_bytes();
  if (!is_direct_ && temporary_.empty()) name_temporary();
  const int descriptor = descriptor_;
  descriptor_ = -1;
  // Network file systems report a full disk only on close.
  if (::close(descriptor) != 0) fail("cannot write");
}

void AtomicFile::take_name(Flush flush) {
  if (is_direct_) return;
  if (::rename(temporary_.c_str(), target_.c_str()) != 0) fail("cannot write");
  temporary_.clear();
  if (flush == Flush::now) flush_name();
}

void AtomicFile::discard() noexcept {
  if (descriptor_ >= 0) ::close(descriptor_);
  if (!temporary_.empty()) ::unlink(temporary_.c_str());
  descriptor_ = -1;
  temporary_.clear();
  sides_.clear();
  std::error_code error;  // a folder that is used by now stays
  for (; !made_folders_.empty(); made_folders_.pop_back())
    std::filesystem::remove(made_folders_.back(), error);
}

void AtomicFile::fail(const char* action) {
  const int error = errno;
  discard();
  throw OutputError(name_, std::string(action) + ": " + std::generic_category().message(error));
}

}  // namespace mesher::io
