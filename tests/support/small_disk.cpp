#include "tests/support/small_disk.h"

#include <fcntl.h>
#include <sched.h>
#include <sys/mount.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <stdexcept>
#include <string>

namespace mesher::test {
namespace {

constexpr const char* kFiller = "filler";

bool write_text(const char* file, const std::string& text) {
  const int descriptor = open(file, O_WRONLY | O_CLOEXEC);
  if (descriptor < 0) return false;
  const ssize_t written = write(descriptor, text.data(), text.size());
  close(descriptor);
  return written == static_cast<ssize_t>(text.size());
}

struct Mount {
  std::string folder;
  std::string options;
  std::string users;  ///< the user's own id, in the new namespace
  std::string groups;
};

/// Returns 0, or why it failed. Called after a fork: only system calls.
int mount_disk(const Mount& wanted) {
  if (unshare(CLONE_NEWUSER | CLONE_NEWNS) == 0) {
    write_text("/proc/self/setgroups", "deny");
    if (!write_text("/proc/self/uid_map", wanted.users)) return errno;
    if (!write_text("/proc/self/gid_map", wanted.groups)) return errno;
  } else if (unshare(CLONE_NEWNS) != 0) {  // which root may do where others may not
    return errno;
  }
  if (mount(nullptr, "/", nullptr, MS_REC | MS_PRIVATE, nullptr) != 0) return errno;
  if (mount("none", wanted.folder.c_str(), "tmpfs", 0, wanted.options.c_str()) != 0) return errno;
  // Otherwise, only root could look below /proc/PID.
  return prctl(PR_SET_DUMPABLE, 1) == 0 ? 0 : errno;
}

[[noreturn]] void keep_disk(const Mount& wanted, int in, int out) {
  const int failure = mount_disk(wanted);
  if (write(out, &failure, sizeof failure) != sizeof failure || failure != 0) _exit(1);
  char byte = 0;
  while (read(in, &byte, 1) > 0 || errno == EINTR)
    errno = 0;
  _exit(0);
}

}  // namespace

SmallDisk::SmallDisk(std::size_t bytes) {
  const Mount wanted{folder_.path().string(), "size=" + std::to_string(bytes),
                     "0 " + std::to_string(geteuid()) + " 1",
                     "0 " + std::to_string(getegid()) + " 1"};
  std::array<int, 2> to_keeper{};
  std::array<int, 2> from_keeper{};
  if (pipe2(to_keeper.data(), O_CLOEXEC) != 0 || pipe2(from_keeper.data(), O_CLOEXEC) != 0)
    throw std::runtime_error("no pipe");
  keeper_ = fork();
  if (keeper_ == 0) {
    close(to_keeper[1]);
    keep_disk(wanted, to_keeper[0], from_keeper[1]);
  }
  close(to_keeper[0]);
  close(from_keeper[1]);
  keeper_pipe_ = to_keeper[1];
  int failure = EPIPE;
  const bool has_answer = read(from_keeper[0], &failure, sizeof failure) == sizeof failure;
  close(from_keeper[0]);
  if (!has_answer || failure != 0) {
    close(keeper_pipe_);
    waitpid(keeper_, nullptr, 0);
    throw std::runtime_error(std::string("a small file system cannot be mounted: ") +
                             std::strerror(failure) + "; run the tests where `unshare -rm` works");
  }
  path_ = "/proc/" + std::to_string(keeper_) + "/root" +
          std::filesystem::canonical(folder_.path()).string();
}

SmallDisk::~SmallDisk() {
  close(keeper_pipe_);
  waitpid(keeper_, nullptr, 0);
}

void SmallDisk::fill() const {
  const int file = open((path_ / kFiller).c_str(), O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0600);
  if (file < 0) throw std::runtime_error("the small disk cannot be filled");
  const std::string page(4096, '#');
  while (write(file, page.data(), page.size()) > 0) {
  }
  const bool is_full = errno == ENOSPC;
  close(file);
  if (!is_full) throw std::runtime_error("the small disk cannot be filled");
}

void SmallDisk::make_room() const {
  std::filesystem::remove(path_ / kFiller);
}

std::size_t SmallDisk::count_files() const {
  std::size_t count = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(path_))
    count += entry.is_regular_file() && entry.path().filename() != kFiller ? 1 : 0;
  return count;
}

}  // namespace mesher::test
