#pragma once

#include <sys/resource.h>
#include <unistd.h>

#include <cstdint>
#include <fstream>

namespace mesher::test {

/// AddressSanitizer ends the program where memory runs out.
#if defined(__SANITIZE_ADDRESS__)
inline constexpr bool kMemoryCanBeScarce = false;
#else
inline constexpr bool kMemoryCanBeScarce = true;
#endif

/// Leaves the process so many bytes that it has not mapped yet, while it lives.
class ScarceMemory {
 public:
  explicit ScarceMemory(std::uint64_t bytes) {
    getrlimit(RLIMIT_AS, &before_);
    std::uint64_t pages = 0;
    std::ifstream("/proc/self/statm") >> pages;
    const rlimit limit{pages * static_cast<std::uint64_t>(sysconf(_SC_PAGESIZE)) + bytes,
                       before_.rlim_max};
    setrlimit(RLIMIT_AS, &limit);
  }
  ~ScarceMemory() { setrlimit(RLIMIT_AS, &before_); }
  ScarceMemory(const ScarceMemory&) = delete;
  ScarceMemory& operator=(const ScarceMemory&) = delete;

 private:
  rlimit before_ = {};
};

}  // namespace mesher::test
