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
std::uint64_t number_in(const std::string& path) {
  std::ifstream file(path);
  std::uint64_t value = 0;
  return file >> value ? value : kUnknown;
}

/// A named number of a file with one on each line; 0 where it is not there.
std::uint64_t named_number_in(const std::string& path, const std::string& name) {
  std::ifstream file(path);
  std::string label;
  std::uint64_t value = 0;
  while (file >> label >> value) {
    if (label == name) return value;
  }
  return 0;
}

/// `cached`: what of the use is files that were read, which make room.
std::uint64_t group_available(const std::string& folder, const char* limit_file,
                              const char* used_file, const char* cached) {
  const std::uint64_t limit = number_in(folder + limit_file);
  const std::uint64_t used = number_in(folder + used_file);
  if (limit == kUnknown || used == kUnknown) return kUnknown;
  const std::uint64_t files = named_number_in(folder + "memory.stat", cached);
  const std::uint64_t held = used > files ? used - files : 0;
  return limit > held ? limit - held : 0;
}

}  // namespace

std::uint64_t available_memory_bytes() {
  return std::min(
      {system_available(),
       group_available("/sys/fs/cgroup/", "memory.max", "memory.current", "inactive_file"),
       group_available("/sys/fs/cgroup/memory/", "memory.limit_in_bytes", "memory.usage_in_bytes",
                       "total_inactive_file")});
}

}  // namespace mesher
