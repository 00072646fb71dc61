// Preloaded into a program: makes the file system misbehave as the environment says (FileFaults).
#include <dlfcn.h>
#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstdarg>
#include <cstdlib>
#include <cstring>
#include <string>

namespace {

template <class Function>
Function* real(const char* name) {
  return reinterpret_cast<Function*>(dlsym(RTLD_NEXT, name));
}

bool is_regular(int descriptor) {
  struct stat status = {};
  return fstat(descriptor, &status) == 0 && S_ISREG(status.st_mode);
}

void note(const std::string& line) {
  const char* const log = std::getenv("FILE_FAULTS_LOG");
  if (log == nullptr) return;
  const int file = real<int(const char*, int, ...)>("open")(
      log, O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0600);
  if (file < 0) return;
  (void)!real<ssize_t(int, const void*, std::size_t)>("write")(file, line.data(), line.size());
  close(file);
}

/// Returns whether this is the call, counted from 1, at which a fault is wanted.
bool is_time(std::atomic<int>& calls) {
  const char* const at = std::getenv("FILE_FAULTS_AT");
  return ++calls == (at == nullptr ? 1 : std::atoi(at));
}

int open_as(const char* name, const char* path, int flags, mode_t mode) {
  if ((flags & O_TMPFILE) == O_TMPFILE && std::getenv("FILE_FAULTS_NO_TMPFILE") != nullptr) {
    errno = EOPNOTSUPP;
    return -1;
  }
  return real<int(const char*, int, ...)>(name)(path, flags, mode);
}

mode_t mode_of(int flags, va_list& rest) {
  return (flags & (O_CREAT | O_TMPFILE)) != 0 ? va_arg(rest, mode_t) : 0;
}

}  // namespace

extern "C" {

int open(const char* path, int flags, ...) {
  va_list rest;
  va_start(rest, flags);
  const mode_t mode = mode_of(flags, rest);
  va_end(rest);
  return open_as("open", path, flags, mode);
}

int open64(const char* path, int flags, ...) {
  va_list rest;
  va_start(rest, flags);
  const mode_t mode = mode_of(flags, rest);
  va_end(rest);
  return open_as("open64", path, flags, mode);
}

ssize_t write(int descriptor, const void* bytes, std::size_t size) {
  static std::atomic<int> calls{0};
  if (is_regular(descriptor)) {
    if (const char* const pause = std::getenv("FILE_FAULTS_SLOW_US")) usleep(std::atoi(pause));
    if (const char* const signal = std::getenv("FILE_FAULTS_SIGNAL")) {
      if (is_time(calls)) kill(getpid(), std::atoi(signal));
    }
  }
  return real<ssize_t(int, const void*, std::size_t)>("write")(descriptor, bytes, size);
}

int fsync(int descriptor) {
  note(is_regular(descriptor) ? "fsync file\n" : "fsync folder\n");
  return real<int(int)>("fsync")(descriptor);
}

int rename(const char* from, const char* to) noexcept {
  note("rename\n");
  return real<int(const char*, const char*)>("rename")(from, to);
}

/// A program advises the system of how it reads a file just after it has mapped it.
int madvise(void* begin, std::size_t size, int advice) noexcept {
  static std::atomic<int> calls{0};
  if (advice == MADV_SEQUENTIAL && is_time(calls)) {
    if (const char* const cut = std::getenv("FILE_FAULTS_CUT")) (void)!truncate(cut, 100);
    if (const char* const changed = std::getenv("FILE_FAULTS_CHANGE")) {
      const int file = real<int(const char*, int, ...)>("open")(changed, O_WRONLY | O_CLOEXEC);
      (void)!real<ssize_t(int, const void*, std::size_t)>("write")(file, "#", 1);
      close(file);
    }
  }
  return real<int(void*, std::size_t, int)>("madvise")(begin, size, advice);
}

}  // extern "C"
