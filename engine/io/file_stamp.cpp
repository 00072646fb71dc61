#include "engine/io/file_stamp.h"

#include <sys/stat.h>

#include <chrono>
#include <ctime>
#include <thread>

namespace mesher::io {
namespace {

/// A smaller file is read in less than a tick, so that the chance of two changes in one, around and
/// within the reading, is not worth the wait.
constexpr off_t kSoonRead = off_t{1} << 20;

std::int64_t nanoseconds(const timespec& time) {
  return std::int64_t{time.tv_sec} * 1'000'000'000 + time.tv_nsec;
}

/// Returns whether a change just now could leave the time of change as it is: file systems take it
/// from the clock of the system's ticks.
bool is_of_this_tick(const timespec& changed) {
  timespec now = {};
  return ::clock_gettime(CLOCK_REALTIME_COARSE, &now) == 0 &&
         nanoseconds(now) == nanoseconds(changed);
}

}  // namespace

FileStamp::FileStamp(int descriptor) {
  struct stat status = {};
  if (::fstat(descriptor, &status) != 0 || !S_ISREG(status.st_mode)) return;
  while (status.st_size > kSoonRead && is_of_this_tick(status.st_ctim)) {
    std::this_thread::sleep_for(std::chrono::microseconds(500));
    if (::fstat(descriptor, &status) != 0) return;
  }
  is_regular_ = true;
  device_ = status.st_dev;
  inode_ = status.st_ino;
  size_ = static_cast<std::uint64_t>(status.st_size);
  written_ns_ = nanoseconds(status.st_mtim);
  changed_ns_ = nanoseconds(status.st_ctim);
}

bool FileStamp::is_current(const std::filesystem::path& file) const {
  if (!is_regular_) return true;
  struct stat status = {};
  return ::stat(file.c_str(), &status) == 0 && status.st_dev == device_ &&
         status.st_ino == inode_ && static_cast<std::uint64_t>(status.st_size) == size_ &&
         nanoseconds(status.st_mtim) == written_ns_ && nanoseconds(status.st_ctim) == changed_ns_;
}

}  // namespace mesher::io
