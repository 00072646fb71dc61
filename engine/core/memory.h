#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace mesher {

/// Returns the number of bytes that this process can still fill: the least of the system's
/// available memory, the rest of the limit of each of its control groups, and the rest of its
/// address-space limit. Returns the largest std::uint64_t if the system reports none of them.
std::uint64_t available_memory_bytes();

/// The control groups of a process, for memory, one path per cgroup version. Empty: the root group.
struct GroupPaths {
  std::string v2;  ///< "/user.slice/session.scope"
  std::string v1;
};

/// Parses the text of /proc/self/cgroup.
GroupPaths parse_group_paths(const std::string& text);

/// Returns a path and all its parents: "/a/b", "/a" and "" (the root).
std::vector<std::string> with_parents(std::string path);

/// Limits further array allocations (engine/core/array.h) of the whole process to `bytes` in total
/// while it lives; freeing arrays does not restore the budget. available_memory_bytes() then
/// returns at most the rest of the budget. It makes out-of-memory paths testable on any machine,
/// and under a sanitizer. Pre: no other MemoryLimit is alive.
class MemoryLimit {
 public:
  explicit MemoryLimit(std::uint64_t bytes);
  ~MemoryLimit();
  MemoryLimit(const MemoryLimit&) = delete;
  MemoryLimit& operator=(const MemoryLimit&) = delete;

  /// Subtracts bytes from the current budget. Returns false, and subtracts nothing, if the budget
  /// is smaller. Returns true if there is no limit.
  static bool take(std::uint64_t bytes);
};

}  // namespace mesher
