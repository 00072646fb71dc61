#include "engine/core/memory.h"

#include <algorithm>
#include <fstream>
#include <limits>
#include <string>

namespace mesher {
namespace {

constexpr std::uint64_t kUnknown = std::numeric_limits<std::uint64_t>::max();

std::uint64_t system_available() {
  std::ifstream file("/proc/meminfo");
  std::string label;
  std::uint64_t kilobytes = 0;
  std::string unit;
  while (file >> label >> kilobytes) {
    if (label == "MemAvailable:") return kilobytes * 1024;
    std::getline(file, unit);
  }
  return kUnknown;
}

/// A number on its own in a file; "max" and what is no number mean no limit.
std::uint64_t number_in(const char* path) {
  std::ifstream file(path);
  std::uint64_t value = 0;
  return file >> value ? value : kUnknown;
}

std::uint64_t group_available(const char* limit_file, const char* used_file) {
  const std::uint64_t limit = number_in(limit_file);
  const std::uint64_t used = number_in(used_file);
  if (limit == kUnknown || used == kUnknown) return kUnknown;
  return limit > used ? limit - used : 0;
}

}  // namespace

std::uint64_t available_memory_bytes() {
  return std::min({system_available(),
                   group_available("/sys/fs/cgroup/memory.max", "/sys/fs/cgroup/memory.current"),
                   group_available("/sys/fs/cgroup/memory/memory.limit_in_bytes",
                                   "/sys/fs/cgroup/memory/memory.usage_in_bytes")});
}

}  // namespace mesher
