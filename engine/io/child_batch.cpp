#include "engine/io/child_batch.h"

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <numeric>
#include <span>
#include <vector>

#include "engine/core/parallel.h"
#include "engine/io/child.h"
#include "engine/io/shared_memory.h"

namespace mesher::io {
namespace {

/// What a child reports of a task. Pipes do not divide so few bytes.
struct TaskReport {
  std::uint32_t task = 0;
  std::uint32_t is_done = 0;
};

/// A number that is taken by one child each.
class SharedCounter {
 public:
  explicit SharedCounter(std::size_t first)
      : memory_(sizeof(std::atomic<std::size_t>)),
        next_(::new (memory_.data()) std::atomic<std::size_t>(first)) {}
  std::size_t take() { return next_->fetch_add(1); }

 private:
  static_assert(std::atomic<std::size_t>::is_always_lock_free);
  SharedMemory memory_;
  std::atomic<std::size_t>* next_;
};

class ChildBatch {
 public:
  ChildBatch(const ChildTasks& tasks, const ChildLimits& limits, Progress* progress)
      : tasks_(tasks), limits_(limits), progress_(progress), is_finished_(tasks.count, false) {}

  void run() {
    std::vector<std::uint32_t> left(tasks_.count);
    std::iota(left.begin(), left.end(), 0U);
    for (bool is_alone = false; !left.empty(); is_alone = true) {
      run_round(left, is_alone);
      std::erase_if(left, [this](std::uint32_t task) { return is_finished_[task]; });
    }
  }

 private:
  /// Finishes at least the first task of each child.
  void run_round(std::span<const std::uint32_t> left, bool is_alone) {
    const std::size_t count = std::min<std::size_t>(left.size(), thread_count());
    Pipe pipe;
    SharedCounter next(is_alone ? left.size() : count);
    std::vector<Child> children;
    for (std::size_t first = 0; first < count; ++first) {
      children.emplace_back(limits_, [&, first] {
        for (std::size_t i = first; i < left.size(); i = next.take())
          if (!do_task(left[i], pipe)) return false;
        return true;
      });
    }
    pipe.close_output();
    take_reports(pipe);
    for (Child& child : children)
      child.wait();
    for (const std::uint32_t task : left.first(count))
      finish(task, ChildOutcome::died);
  }

  bool do_task(std::uint32_t task, const Pipe& pipe) const {
    limit_cpu_time(limits_.cpu_s);
    bool is_done = false;
    try {
      is_done = tasks_.work(task);
    } catch (...) {
    }
    const TaskReport report{task, is_done ? 1U : 0U};
    return pipe.write({reinterpret_cast<const char*>(&report), sizeof(report)});
  }

  void take_reports(const Pipe& pipe) {
    TaskReport report;
    while (pipe.read(reinterpret_cast<char*>(&report), sizeof(report), progress_) == sizeof(report))
      finish(report.task, report.is_done != 0 ? ChildOutcome::done : ChildOutcome::refused);
  }

  /// A child that handled hostile data may report anything.
  void finish(std::uint32_t task, ChildOutcome outcome) {
    if (task >= tasks_.count || is_finished_[task]) return;
    is_finished_[task] = true;
    tasks_.finished(task, outcome);
  }

  const ChildTasks& tasks_;
  const ChildLimits& limits_;
  Progress* progress_;
  std::vector<bool> is_finished_;
};

}  // namespace

void run_in_children(const ChildTasks& tasks, const ChildLimits& limits, Progress* progress) {
  ChildBatch(tasks, limits, progress).run();
}

}  // namespace mesher::io
