#pragma once

#include <cstddef>
#include <functional>

#include "engine/core/progress.h"
#include "engine/io/child_process.h"

namespace mesher::io {

/// Work that is divided into tasks.
struct ChildTasks {
  std::size_t count = 0;
  /// Does a task, in a child. Its result goes to memory that is shared (SharedMemory). Returns
  /// whether it succeeded. What it may do: see run_in_child.
  std::function<bool(std::size_t task)> work;
  /// Takes the outcome of a task, in this process and on this thread, while other tasks still run:
  /// done, refused or died. It may throw, which kills all children.
  std::function<void(std::size_t task, ChildOutcome outcome)> finished;
};

/// Does all tasks in copies of this process, as many at a time as there are threads. Each copy
/// takes one task after another, so that many small tasks need few processes. `limits` hold for
/// each task; output does not count.
///
/// A crash ends a task only if it is the first one of its child. Otherwise an earlier task may have
/// caused it, so the task gets a child of its own, like all that were left.
///
/// Throws DeviceError if the system starts no process; Cancelled, and then all children are killed.
void run_in_children(const ChildTasks& tasks, const ChildLimits& limits,
                     Progress* progress = nullptr);

}  // namespace mesher::io
