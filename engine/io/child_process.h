#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <string_view>

#include "engine/core/progress.h"

namespace mesher::io {

/// Bounds on what a child process may use.
struct ChildLimits {
  std::size_t memory = std::size_t{4} << 30U;  ///< bytes, beyond those of this process
  unsigned cpu_s = 120;
  std::size_t output = std::size_t{1} << 30U;  ///< bytes
};

enum class ChildOutcome {
  done,
  refused,   ///< the work returned false or threw
  died,      ///< of a signal: a crash, or a limit
  too_long,  ///< more output than allowed
};
struct ChildResult {
  ChildOutcome outcome = ChildOutcome::refused;
  std::string bytes;  ///< all that the work wrote; empty unless done
};

/// Receives the output of the work. Returns false once it cannot be written.
using ChildWriter = std::function<bool(std::string_view bytes)>;

/// Runs `work` in a copy of this process, and returns what it wrote. For decoders of other
/// libraries that a hostile file may crash or make allocate without bound: the child dies, this
/// process does not. The work must only compute: it may not use threads, the GPU or standard
/// streams.
///
/// Throws DeviceError if the system starts no process; Cancelled, and then the child is killed.
ChildResult run_in_child(const std::function<bool(const ChildWriter& write)>& work,
                         const ChildLimits& limits, Progress* progress = nullptr);

}  // namespace mesher::io
