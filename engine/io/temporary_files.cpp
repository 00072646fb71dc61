#include "engine/io/temporary_files.h"

#include <dirent.h>
#include <fcntl.h>
#include <poll.h>
#include <sys/file.h>
#include <sys/random.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdint>
#include <mutex>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace mesher::io {
namespace {

constexpr int kEndSignals[] = {SIGINT, SIGTERM, SIGHUP};
constexpr std::string_view kPrefix = ".mesher-";
constexpr std::string_view kSuffix = ".tmp";
constexpr std::size_t kDigits = 16;
constexpr int kMostWaitMs = 2000;

std::mutex list_mutex;               ///< between threads; a signal waits for `changing` instead
std::vector<std::string> list;       ///< folders before what they hold
std::atomic<int> changing{0};        ///< number of threads within NoSignals
std::atomic<bool> is_ending{false};  ///< a signal has begun to end the process
std::atomic<pid_t> list_owner{0};    ///< the process that the list is of; not a child of it
thread_local int depth = 0;          ///< of NoSignals

}  // namespace

/// Calls only functions that a signal handler may call.
void remove_temporaries() {
  is_ending.store(true);
  for (int waited = 0; changing.load() > 0 && waited < kMostWaitMs; ++waited)
    ::poll(nullptr, 0, 1);
  if (changing.load() > 0) return;  // a file system hangs: the next write sweeps
  for (std::size_t i = list.size(); i-- > 0;) {
    if (::unlink(list[i].c_str()) != 0) ::rmdir(list[i].c_str());
  }
}

namespace {

extern "C" void end_by_signal(int signal) {
  if (::getpid() == list_owner.load()) remove_temporaries();
  std::signal(signal, SIG_DFL);
  ::raise(signal);  // is delivered when this returns
}

bool is_temporary_name(std::string_view name) {
  if (name.size() != kPrefix.size() + kDigits + kSuffix.size()) return false;
  const std::string_view digits = name.substr(kPrefix.size(), kDigits);
  return name.starts_with(kPrefix) && name.ends_with(kSuffix) &&
         digits.find_first_not_of("0123456789abcdef") == std::string_view::npos;
}

/// Removes a file that is ours and that nobody has locked.
void remove_if_stale(int folder, const char* name) noexcept {
  const int file = ::openat(folder, name, O_WRONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC);
  if (file < 0) return;
  struct stat status = {};
  const bool is_ours =
      ::fstat(file, &status) == 0 && S_ISREG(status.st_mode) && status.st_uid == ::geteuid();
  if (is_ours && ::flock(file, LOCK_EX | LOCK_NB) == 0) ::unlinkat(folder, name, 0);
  ::close(file);
}

/// Returns whether this process has not looked into the folder before.
bool is_new_folder(const std::filesystem::path& folder) {
  static std::mutex mutex;
  static std::set<std::filesystem::path> seen;
  const std::lock_guard lock(mutex);
  return seen.insert(folder).second;
}

}  // namespace

NoSignals::NoSignals() {
  sigset_t ending;
  sigemptyset(&ending);
  for (const int signal : kEndSignals)
    sigaddset(&ending, signal);
  ::pthread_sigmask(SIG_BLOCK, &ending, &before_);
  if (depth++ > 0) return;
  ++changing;
  if (!is_ending.load()) return;
  // The process ends in a moment, and nothing new may appear until then.
  --changing;
  for (;;)
    ::pause();
}

NoSignals::~NoSignals() {
  if (--depth == 0) --changing;
  ::pthread_sigmask(SIG_SETMASK, &before_, nullptr);
}

void remove_temporaries_on_signals() {
  list_owner = ::getpid();
  for (const int signal : kEndSignals) {
    struct sigaction action = {};
    if (::sigaction(signal, nullptr, &action) != 0 || action.sa_handler == SIG_IGN) continue;
    action = {};
    action.sa_handler = end_by_signal;
    ::sigaction(signal, &action, nullptr);
  }
}

void list_temporary(const std::filesystem::path& path) {
  const std::lock_guard lock(list_mutex);
  list.push_back(path.string());
}

void unlist_temporary(const std::filesystem::path& path) noexcept {
  const std::lock_guard lock(list_mutex);
  const auto found = std::find(list.rbegin(), list.rend(), path.native());
  if (found != list.rend()) list.erase(std::next(found).base());
}

void sweep_temporaries(const std::filesystem::path& folder) noexcept {
  try {
    if (!is_new_folder(folder)) return;
    DIR* const entries = ::opendir(folder.c_str());
    if (entries == nullptr) return;
    while (const dirent* entry = ::readdir(entries)) {
      if (is_temporary_name(entry->d_name)) remove_if_stale(::dirfd(entries), entry->d_name);
    }
    ::closedir(entries);
  } catch (...) {
    // Without memory for a path, stale files stay until the next time.
  }
}

std::string temporary_name() {
  std::uint64_t bits = 0;
  if (::getrandom(&bits, sizeof(bits), 0) != static_cast<ssize_t>(sizeof(bits))) {
    // A sandbox may refuse it. Then these differ between processes and within one.
    static std::atomic<std::uint64_t> counter{0};
    bits = (static_cast<std::uint64_t>(::getpid()) << 40U) ^ counter++ ^
           static_cast<std::uint64_t>(std::chrono::steady_clock::now().time_since_epoch().count());
  }
  std::string name(kPrefix);
  for (std::size_t i = 0; i < kDigits; ++i, bits >>= 4)
    name += "0123456789abcdef"[bits & 15U];
  return name.append(kSuffix);
}

bool lock_temporary(int descriptor) noexcept {
  return ::flock(descriptor, LOCK_EX | LOCK_NB) == 0 || errno != EWOULDBLOCK;
}

}  // namespace mesher::io
