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

}  // namespace mesher
