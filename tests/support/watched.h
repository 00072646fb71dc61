#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <exception>
#include <functional>
#include <iostream>
#include <random>
#include <string>
#include <thread>
#include <vector>

#include "engine/core/error.h"
#include "engine/core/progress.h"

namespace mesher::test {

/// What another thread saw of a Progress while an operation ran.
struct Watched {
  std::vector<float> fractions;     ///< without repetitions
  std::vector<std::string> stages;  ///< the same
  float at_end = 0.0F;

  bool rises() const { return std::ranges::is_sorted(fractions); }
  /// Returns whether the stages occur in this order. The watcher may have missed some.
  bool has_order(const std::vector<std::string>& order) const {
    auto at = order.begin();
    for (const std::string& stage : stages) {
      at = std::find(at, order.end(), stage);
      if (at == order.end()) return false;
    }
    return true;
  }
};

/// Runs an operation and watches it.
inline Watched watched(const std::function<void(Progress*)>& operation) {
  Watched seen;
  Progress progress;
  std::atomic<bool> is_watching{false};
  std::atomic<bool> is_done{false};
  const auto look = [&] {
    const float fraction = progress.fraction();
    const std::string stage = progress.stage();
    if (seen.fractions.empty() || seen.fractions.back() != fraction)
      seen.fractions.push_back(fraction);
    if (!stage.empty() && (seen.stages.empty() || seen.stages.back() != stage))
      seen.stages.push_back(stage);
  };
  std::thread watcher([&] {
    while (!is_done) {
      look();
      is_watching = true;
      std::this_thread::yield();
    }
  });
  while (!is_watching)
    std::this_thread::yield();
  try {
    operation(&progress);
  } catch (const std::exception& error) {
    ADD_FAILURE() << error.what();
  }
  is_done = true;
  watcher.join();
  look();
  seen.at_end = progress.fraction();
  return seen;
}

/// Expects that the fraction never falls and ends at 1, and that the stages come in this order, of
/// which at least the last is seen.
inline void expect_one_progress(const Watched& seen, const std::vector<std::string>& order) {
  EXPECT_TRUE(seen.rises());
  EXPECT_EQ(seen.at_end, 1.0F);
  EXPECT_TRUE(seen.has_order(order)) << testing::PrintToString(seen.stages);
  ASSERT_FALSE(seen.stages.empty());
  EXPECT_EQ(seen.stages.back(), order.back());
  EXPECT_GE(seen.fractions.size(), 3U) << "hardly anything was reported";
}

/// Runs an operation several times, cancels it after different times, and expects that each run
/// either ends or throws Cancelled. `on_cancel` is called after each canceled run. Prints how long
/// the longest run went on after its cancellation.
inline void cancel_at_random_moments(const std::string& name,
                                     const std::function<void(Progress*)>& operation,
                                     const std::function<void()>& on_cancel = {}, int runs = 12) {
  using Clock = std::chrono::steady_clock;
  using Milliseconds = std::chrono::duration<double, std::milli>;
  const auto start = Clock::now();
  operation(nullptr);
  const double whole_ms = Milliseconds(Clock::now() - start).count();
  std::mt19937 random(1);
  double most_ms = 0.0;
  int cancelled = 0;
  for (int run = 0; run < runs; ++run) {
    Progress progress;
    Clock::time_point at;
    const double wait_ms = whole_ms * (run + double(random()) / 4294967296.0) / runs;
    std::thread canceller([&] {
      std::this_thread::sleep_for(Milliseconds(wait_ms));
      at = Clock::now();
      progress.cancel();
    });
    bool is_cancelled = false;
    try {
      operation(&progress);
    } catch (const Cancelled&) {
      is_cancelled = true;
    }
    const auto end = Clock::now();
    canceller.join();
    if (!is_cancelled) continue;
    ++cancelled;
    most_ms = std::max(most_ms, Milliseconds(end - at).count());
    if (on_cancel) on_cancel();
  }
  EXPECT_GT(cancelled, 0) << name;
  std::cout << name << ": " << whole_ms << " ms; " << cancelled << " of " << runs
            << " runs canceled, at most " << most_ms << " ms late\n";
}

}  // namespace mesher::test
