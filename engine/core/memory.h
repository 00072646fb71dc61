#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace mesher {

/// Bytes that this process can still fill before the machine, its container or its own limit runs
/// out: what the system calls available, or what is left of the limit of a control group that it is
/// in or of its address space, where that is less. The highest number there is where the system
/// does not say.
std::uint64_t available_memory_bytes();

/// In which control group a process is, for memory, by either version; empty: in none but the root.
struct GroupPaths {
  std::string v2;  ///< "/user.slice/session.scope"
  std::string v1;
};

/// What /proc/self/cgroup says.
GroupPaths parse_group_paths(const std::string& text);

/// "/a/b", "/a" and "", which is the root.
std::vector<std::string> with_parents(std::string path);

/// As long as it lives, arrays of the whole process (engine/core/array.h) may take so many bytes
/// more and no others, freed or not; what is available is at most that. What runs out of memory can
/// so be shown on any machine, under a sanitizer, too. One at a time.
class MemoryLimit {
 public:
  explicit MemoryLimit(std::uint64_t bytes);
  ~MemoryLimit();
  MemoryLimit(const MemoryLimit&) = delete;
  MemoryLimit& operator=(const MemoryLimit&) = delete;

  /// Takes bytes off the limit there is. False where it does not hold them; true where there is
  /// none.
  static bool take(std::uint64_t bytes);
};

}  // namespace mesher
