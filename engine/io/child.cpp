#include "engine/io/child.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <fstream>

#include "engine/core/error.h"
#include "engine/core/memory.h"

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

[[noreturn]] void run_child(const std::function<bool()>& work, const ChildLimits& limits,
                            std::size_t space) {
  // What the parent does about these is not for the child. A crash leaves no core file, and nothing
  // that a library prints reaches the terminal.
  for (const int signal : {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT, SIGTERM, SIGINT, SIGPIPE})
    ::signal(signal, SIG_DFL);
  limit(RLIMIT_CORE, 0);
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);  // not longer than the parent, which a TimeLimit may end
  limit_cpu_time(limits.cpu_s);
  // A sanitizer reserves terabytes.
  const std::uint64_t memory = std::min<std::uint64_t>(limits.memory, MemoryLimit::left());
  if (!kHasSanitizer) limit(RLIMIT_AS, space + memory);
  const int nothing = ::open("/dev/null", O_WRONLY);
  ::dup2(nothing, STDOUT_FILENO);
  ::dup2(nothing, STDERR_FILENO);
  bool is_done = false;
  try {
    is_done = work();
  } catch (...) {
  }
  ::_exit(is_done ? 0 : kRefused);
}

}  // namespace

void PipeEnd::close() {
  if (number_ >= 0) ::close(number_);
  number_ = -1;
}

std::pair<int, int> Pipe::open() {
  int ends[2];
  if (::pipe2(ends, O_CLOEXEC) != 0) throw DeviceError("cannot open a pipe");
  return {ends[0], ends[1]};
}

bool Pipe::write(std::string_view bytes) const {
  while (!bytes.empty()) {
    const ssize_t written = ::write(output_.number(), bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) return false;
    bytes.remove_prefix(static_cast<std::size_t>(written));
  }
  return true;
}

std::size_t Pipe::read(char* bytes, std::size_t most, const Progress* progress) const {
  constexpr int kBetweenChecks_ms = 50;
  for (;;) {
    check_cancelled(progress);
    pollfd ready{.fd = input_.number(), .events = POLLIN, .revents = 0};
    if (::poll(&ready, 1, kBetweenChecks_ms) <= 0) continue;
    const ssize_t count = ::read(input_.number(), bytes, most);
    if (count < 0 && errno == EINTR) continue;
    return count < 0 ? 0 : static_cast<std::size_t>(count);
  }
}

Child::Child(const ChildLimits& limits, const std::function<bool()>& work) : id_(-1) {
  const std::size_t space = address_space();
  id_ = ::fork();
  if (id_ < 0) throw DeviceError("cannot start a process");
  if (id_ == 0) run_child(work, limits, space);
}

Child::~Child() {
  if (id_ <= 0) return;
  ::kill(id_, SIGKILL);
  wait();
}

int Child::wait() {
  int status = 0;
  while (::waitpid(id_, &status, 0) < 0 && errno == EINTR) {
  }
  id_ = -1;
  return status;
}

void limit_cpu_time(unsigned seconds) {
  rusage used{};
  ::getrusage(RUSAGE_SELF, &used);
  rlimit value{};
  ::getrlimit(RLIMIT_CPU, &value);
  const auto end = static_cast<rlim_t>(used.ru_utime.tv_sec + used.ru_stime.tv_sec) + 1 + seconds;
  // The hard limit stays, so that this one can be raised for another task.
  value.rlim_cur = std::min(end, value.rlim_max);
  ::setrlimit(RLIMIT_CPU, &value);
}

}  // namespace mesher::io
