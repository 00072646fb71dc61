#include "engine/io/spool.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/mman.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <string_view>
#include <system_error>

#include "engine/core/error.h"
#include "engine/core/memory.h"
#include "engine/io/child.h"

namespace mesher::io {
namespace {

constexpr int kBetweenChecks_ms = 50;

mode_t mode_of(int descriptor) {
  struct stat status = {};
  return ::fstat(descriptor, &status) == 0 ? status.st_mode : 0;
}

/// Waits a moment for the end of a pipe or socket. Returns whether nobody will write any more.
bool has_ended(int descriptor) {
  pollfd end{descriptor, POLLRDHUP, 0};
  return ::poll(&end, 1, kBetweenChecks_ms) > 0 &&
         (end.revents & (POLLHUP | POLLERR | POLLRDHUP)) != 0;
}

/// Returns what has arrived in a pipe, without consuming it.
std::string peek_pipe(int descriptor, std::size_t most) {
  int copy[2];
  if (::pipe2(copy, O_CLOEXEC) != 0) return {};
  const PipeEnd output(copy[0]);
  const PipeEnd input(copy[1]);
  std::string bytes(most, '\0');
  const ssize_t copied = ::tee(descriptor, input.number(), most, SPLICE_F_NONBLOCK);
  const ssize_t got =
      copied > 0 ? ::read(output.number(), bytes.data(), static_cast<std::size_t>(copied)) : 0;
  bytes.resize(static_cast<std::size_t>(std::max<ssize_t>(got, 0)));
  return bytes;
}

std::string peek_socket(int descriptor, std::size_t most) {
  std::string bytes(most, '\0');
  const ssize_t got = ::recv(descriptor, bytes.data(), most, MSG_PEEK | MSG_DONTWAIT);
  bytes.resize(static_cast<std::size_t>(std::max<ssize_t>(got, 0)));
  return bytes;
}

std::string peek_file(int descriptor, std::size_t most) {
  std::string bytes(most, '\0');
  const ssize_t got = ::pread(descriptor, bytes.data(), most, 0);
  bytes.resize(static_cast<std::size_t>(std::max<ssize_t>(got, 0)));
  return bytes;
}

/// The bytes of a pipe, in memory.
class Spool {
 public:
  explicit Spool(const std::string& name)
      : name_(name), memory_(::memfd_create("input", MFD_CLOEXEC)) {
    if (memory_.number() < 0) fail();
  }

  void read_all(int from, const Progress* progress) {
    for (;;) {
      check_cancelled(progress);
      pollfd readable{from, POLLIN, 0};
      if (::poll(&readable, 1, kBetweenChecks_ms) == 0) continue;
      const ssize_t got = ::read(from, block_.data(), block_.size());
      if (got < 0 && (errno == EINTR || errno == EAGAIN)) continue;
      if (got < 0) fail();
      if (got == 0) return;
      append({block_.data(), static_cast<std::size_t>(got)});
    }
  }

  /// Makes a descriptor one of this file, at its beginning.
  void replace(int descriptor) {
    ::lseek(memory_.number(), 0, SEEK_SET);
    if (::dup2(memory_.number(), descriptor) < 0) fail();
  }

 private:
  void append(std::string_view bytes) {
    if (!MemoryLimit::take(bytes.size())) throw_out_of_memory(name_);
    while (!bytes.empty()) {
      const ssize_t done = ::write(memory_.number(), bytes.data(), bytes.size());
      if (done < 0 && errno == EINTR) continue;
      if (done < 0) throw_out_of_memory(name_);
      bytes.remove_prefix(static_cast<std::size_t>(done));
    }
  }

  [[noreturn]] void fail() const {
    throw InputError(name_, 0, "cannot read: " + std::generic_category().message(errno));
  }

  const std::string& name_;
  PipeEnd memory_;
  std::array<char, std::size_t{1} << 16U> block_;
};

}  // namespace

std::string peek(int descriptor, std::size_t most, const Progress* progress) {
  const mode_t mode = mode_of(descriptor);
  if (S_ISREG(mode)) return peek_file(descriptor, most);
  if (!S_ISFIFO(mode) && !S_ISSOCK(mode)) return {};
  for (bool is_at_end = false;;) {
    check_cancelled(progress);
    std::string bytes =
        S_ISFIFO(mode) ? peek_pipe(descriptor, most) : peek_socket(descriptor, most);
    if (bytes.size() == most || is_at_end) return bytes;
    is_at_end = has_ended(descriptor);  // then what arrived until now is all
  }
}

void spool(int descriptor, const std::string& name, const Progress* progress) {
  const mode_t mode = mode_of(descriptor);
  if (!S_ISFIFO(mode) && !S_ISSOCK(mode)) return;
  Spool copy(name);
  copy.read_all(descriptor, progress);
  copy.replace(descriptor);
}

}  // namespace mesher::io
