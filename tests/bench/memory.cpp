#include "tests/bench/memory.h"

#include <malloc.h>

#include <algorithm>
#include <fstream>
#include <sstream>
#include <string>
#include <string_view>

namespace mesher::bench {
namespace {

/// A field of /proc/self/status in bytes; 0 if there is none.
std::uint64_t status_bytes(std::string_view field) {
  std::ifstream status("/proc/self/status");
  for (std::string line; std::getline(status, line);) {
    if (!line.starts_with(field)) continue;
    std::istringstream words(line.substr(field.size() + 1));
    std::uint64_t kib = 0;
    words >> kib;
    return kib * 1024;
  }
  return 0;
}

}  // namespace

PeakMemory::PeakMemory() {
  // Return pages of earlier work to the system. Otherwise they would be reused without being
  // counted.
  malloc_trim(0);
  std::ofstream("/proc/self/clear_refs") << "5";  // resets the high-water mark
  start_ = status_bytes("VmRSS");
}

std::uint64_t PeakMemory::rise_bytes() const {
  return std::max(status_bytes("VmHWM"), start_) - start_;
}

}  // namespace mesher::bench
