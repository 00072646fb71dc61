#include "engine/io/child_batch.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <cstdint>
#include <span>
#include <stdexcept>
#include <thread>
#include <vector>

#include "engine/core/error.h"
#include "engine/core/parallel.h"
#include "engine/io/shared_memory.h"
#include "tests/support/sanitized.h"

namespace mesher::io {
namespace {

using Work = std::function<bool(std::size_t)>;

/// Returns the outcome of each task, and checks that each has exactly one.
std::vector<ChildOutcome> outcomes_of(std::size_t count, const Work& work,
                                      const ChildLimits& limits = {}) {
  std::vector<ChildOutcome> outcomes(count, ChildOutcome::too_long);
  run_in_children({.count = count,
                   .work = work,
                   .finished =
                       [&](std::size_t task, ChildOutcome outcome) {
                         EXPECT_EQ(outcomes.at(task), ChildOutcome::too_long);
                         outcomes.at(task) = outcome;
                       }},
                  limits);
  return outcomes;
}

TEST(ChildBatch, ResultsComeThroughSharedMemory) {
  constexpr std::size_t kTasks = 100;
  for (const unsigned threads : {1U, 3U}) {
    const ThreadLimit limit(threads);
    const SharedMemory memory(kTasks);
    const auto outcomes = outcomes_of(kTasks, [&](std::size_t i) {
      memory.data()[i] = static_cast<std::uint8_t>(i + 1);
      return true;
    });
    for (std::size_t i = 0; i < kTasks; ++i) {
      EXPECT_EQ(outcomes[i], ChildOutcome::done);
      EXPECT_EQ(memory.data()[i], i + 1);
    }
  }
}

TEST(ChildBatch, NoTasksNeedNoChild) {
  EXPECT_TRUE(outcomes_of(0, [](std::size_t) { return true; }).empty());
}

TEST(ChildBatch, RefusalsAndExceptionsEndOnlyTheirTask) {
  const auto outcomes = outcomes_of(9, [](std::size_t i) {
    if (i % 3 == 1) throw std::runtime_error("in the library");
    return i % 3 == 0;
  });
  for (std::size_t i = 0; i < outcomes.size(); ++i)
    EXPECT_EQ(outcomes[i], i % 3 == 0 ? ChildOutcome::done : ChildOutcome::refused) << i;
}

TEST(ChildBatch, CrashEndsOnlyItsTask) {
  for (const unsigned threads : {1U, 2U, 8U}) {
    const ThreadLimit limit(threads);
    const auto outcomes = outcomes_of(12, [](std::size_t i) {
      if (i % 4 == 2) std::raise(SIGSEGV);
      return true;
    });
    for (std::size_t i = 0; i < outcomes.size(); ++i)
      EXPECT_EQ(outcomes[i], i % 4 == 2 ? ChildOutcome::died : ChildOutcome::done) << i;
  }
}

TEST(ChildBatch, TaskIsNotBlamedForWhatAnotherBroke) {
  const ThreadLimit limit(1);
  bool is_broken = false;  // in the child
  const auto outcomes = outcomes_of(3, [&](std::size_t i) {
    if (is_broken) std::raise(SIGSEGV);
    is_broken = i == 0;
    return true;
  });
  EXPECT_EQ(outcomes, std::vector<ChildOutcome>(3, ChildOutcome::done));
}

TEST(ChildBatch, LimitsHoldForEachTask) {
  const ThreadLimit limit(1);
  const auto outcomes = outcomes_of(3,
                                    [](std::size_t i) {
                                      const volatile bool runs = true;
                                      while (i == 1 && runs) {
                                      }
                                      return true;
                                    },
                                    {.cpu_s = 1});
  EXPECT_EQ(outcomes, (std::vector<ChildOutcome>{ChildOutcome::done, ChildOutcome::died,
                                                 ChildOutcome::done}));
  if (test::kSanitized) return;  // its memory cannot be limited
  const auto refused = outcomes_of(1,
                                   [](std::size_t) {
                                     std::vector<char> all(std::size_t{1} << 30);
                                     return all[12345] == 0;
                                   },
                                   {.memory = std::size_t{1} << 28});
  EXPECT_EQ(refused[0], ChildOutcome::refused);
}

TEST(ChildBatch, ExceptionOfTheParentKillsTheChildren) {
  const ThreadLimit limit(2);
  const ChildTasks tasks{
      .count = 2,
      .work =
          [](std::size_t i) {
            if (i == 1) ::sleep(1000);
            return true;
          },
      .finished = [](std::size_t, ChildOutcome) { throw DeviceError("no memory for the result"); }};
  EXPECT_THROW(run_in_children(tasks, {}), DeviceError);
}

TEST(ChildBatch, CancellationKillsTheChildren) {
  Progress progress;
  std::thread canceling([&] {
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
    progress.cancel();
  });
  const ChildTasks tasks{.count = 4,
                         .work =
                             [](std::size_t) {
                               ::sleep(1000);
                               return true;
                             },
                         .finished = [](std::size_t, ChildOutcome) {}};
  EXPECT_THROW(run_in_children(tasks, {}, &progress), Cancelled);
  canceling.join();
}

}  // namespace
}  // namespace mesher::io
