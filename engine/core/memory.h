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

/// Limits the memory that the whole process takes at one time while it lives. The process counts
/// what it allocates, so that the limit is the same on every machine, and under a sanitizer.
/// available_memory_bytes() returns at most the rest. Not counted: mapped files, and what libraries
/// in C and the driver of the GPU allocate. Pre: no other MemoryLimit is alive.
class MemoryLimit {
 public:
  enum class Of {
    arrays,      ///< those of engine/core/array.h. Makes out-of-memory paths testable.
    everything,  ///< also operator new: what a person who gives a limit means
  };
  /// Small blocks are counted, but refused only this many bytes past the limit, so that messages
  /// can still be made.
  static constexpr std::uint64_t kRoomForSmallBlocks = std::uint64_t{16} << 20U;

  explicit MemoryLimit(std::uint64_t bytes, Of what = Of::arrays);
  ~MemoryLimit();
  MemoryLimit(const MemoryLimit&) = delete;
  MemoryLimit& operator=(const MemoryLimit&) = delete;

  /// Counts bytes that will be allocated. Returns false, and counts nothing, if the limit leaves
  /// fewer. Returns true if there is no limit. Thread-safe, as all functions here.
  static bool take(std::uint64_t bytes) noexcept;
  /// Counts bytes that were freed.
  static void give_back(std::uint64_t bytes) noexcept;
  /// Returns how many bytes the limit leaves; the largest std::uint64_t without a limit.
  static std::uint64_t left() noexcept;
  /// Returns the most bytes that were taken at one time under the current or the last limit.
  static std::uint64_t peak() noexcept;
  /// Returns whether there is a limit of everything.
  static bool counts_everything() noexcept;
  /// Returns what a limit of everything refused last: "--max-memory is 100 MB, of which 80 MB are
  /// in use; 40 MB more are needed". Empty: nothing.
  static std::string refusal();

  // For operator new.

  /// Same as `take`, for a block that may be a small one.
  static bool take_block(std::uint64_t bytes) noexcept;
  /// Replaces a number of bytes that was taken by the number that was allocated.
  static void correct(std::uint64_t taken, std::uint64_t allocated) noexcept;
};

/// Throws what running out of memory means: LimitError if a limit of everything was reached, and
/// otherwise DeviceError. `subject`: what needed the memory; may be empty.
[[noreturn]] void throw_out_of_memory(const std::string& subject);

}  // namespace mesher
