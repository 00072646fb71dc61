#include "engine/io/child_process.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <fstream>

#include "engine/core/error.h"

namespace mesher::io {
namespace {

#if defined(__SANITIZE_ADDRESS__)
constexpr bool kHasSanitizer = true;
#elif defined(__has_feature)
#if __has_feature(address_sanitizer)
constexpr bool kHasSanitizer = true;
#else
constexpr bool kHasSanitizer = false;
#endif
#else
constexpr bool kHasSanitizer = false;
#endif

constexpr int kRefused = 1;

/// A file descriptor that is closed at the end.
class PipeEnd {
 public:
  explicit PipeEnd(int number) : number_(number) {}
  ~PipeEnd() { close(); }
  PipeEnd(const PipeEnd&) = delete;
  PipeEnd& operator=(const PipeEnd&) = delete;
  int number() const { return number_; }
  void close() {
    if (number_ >= 0) ::close(number_);
    number_ = -1;
  }

 private:
  int number_;
};

/// A child process that is killed, unless it has ended, and waited for.
class Child {
 public:
  explicit Child(pid_t id) : id_(id) {}
  ~Child() {
    if (id_ <= 0) return;
    ::kill(id_, SIGKILL);
    wait();
  }
  Child(const Child&) = delete;
  Child& operator=(const Child&) = delete;
  /// Returns the status of waitpid.
  int wait() {
    int status = 0;
    while (::waitpid(id_, &status, 0) < 0 && errno == EINTR) {
    }
    id_ = -1;
    return status;
  }

 private:
  pid_t id_;
};

/// Returns the address space that this process takes, in bytes.
std::size_t address_space() {
  std::size_t pages = 0;
  std::ifstream("/proc/self/statm") >> pages;
  return pages * static_cast<std::size_t>(::sysconf(_SC_PAGESIZE));
}

void limit(int resource, rlim_t most) {
  const rlimit value{most, most};
  ::setrlimit(static_cast<__rlimit_resource>(resource), &value);
}

bool write_all(int descriptor, std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t written = ::write(descriptor, bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) return false;
    bytes.remove_prefix(static_cast<std::size_t>(written));
  }
  return true;
}

[[noreturn]] void run_child(const std::function<bool(const ChildWriter&)>& work,
                            const ChildLimits& limits, std::size_t space, int output) {
  // What the parent does about these is not for the child. A crash leaves no core file, and nothing
  // that a library prints reaches the terminal.
  for (const int signal : {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT, SIGTERM, SIGINT, SIGPIPE})
    ::signal(signal, SIG_DFL);
  limit(RLIMIT_CORE, 0);
  limit(RLIMIT_CPU, limits.cpu_s);
  // A sanitizer reserves terabytes.
  if (!kHasSanitizer) limit(RLIMIT_AS, space + limits.memory);
  const int nothing = ::open("/dev/null", O_WRONLY);
  ::dup2(nothing, STDOUT_FILENO);
  ::dup2(nothing, STDERR_FILENO);
  bool is_done = false;
  try {
    is_done = work([output](std::string_view bytes) { return write_all(output, bytes); });
  } catch (...) {
  }
  ::_exit(is_done ? 0 : kRefused);
}

/// Reads to the end. Returns false if there is more than `most`.
bool read_all(int descriptor, std::size_t most, Progress* progress, std::string& bytes) {
  constexpr int kBetweenChecks_ms = 50;
  std::array<char, std::size_t{1} << 16U> block;
  for (;;) {
    check_cancelled(progress);
    pollfd ready{.fd = descriptor, .events = POLLIN, .revents = 0};
    if (::poll(&ready, 1, kBetweenChecks_ms) <= 0) continue;
    const ssize_t count = ::read(descriptor, block.data(), block.size());
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) return true;
    if (bytes.size() + static_cast<std::size_t>(count) > most) return false;
    bytes.append(block.data(), static_cast<std::size_t>(count));
  }
}

}  // namespace

ChildResult run_in_child(const std::function<bool(const ChildWriter&)>& work,
                         const ChildLimits& limits, Progress* progress) {
  int ends[2];
  if (::pipe2(ends, O_CLOEXEC) != 0) throw DeviceError("cannot open a pipe");
  PipeEnd input(ends[0]);
  PipeEnd output(ends[1]);
  const std::size_t space = address_space();
  const pid_t id = ::fork();
  if (id < 0) throw DeviceError("cannot start a process");
  if (id == 0) run_child(work, limits, space, output.number());
  Child child(id);
  output.close();
  ChildResult result;
  if (!read_all(input.number(), limits.output, progress, result.bytes)) {
    return {ChildOutcome::too_long, {}};
  }
  const int status = child.wait();
  if (WIFEXITED(status) && WEXITSTATUS(status) == 0) {
    result.outcome = ChildOutcome::done;
    return result;
  }
  return {WIFSIGNALED(status) ? ChildOutcome::died : ChildOutcome::refused, {}};
}

}  // namespace mesher::io
