#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <exception>
#include <functional>
#include <iostream>
#include <mutex>
#include <string>
#include <string_view>
#include <vector>

#include "engine/core/error.h"
#include "engine/core/progress.h"

namespace mesher::test {

/// All that an operation told a Progress, in this order.
struct Watched {
  std::vector<float> fractions;     ///< ascending
  std::vector<std::string> stages;  ///< without repetitions in a row
  float at_end = 0.0F;

  /// Returns whether the stages occur in this order. Some may be missing.
  bool has_order(const std::vector<std::string>& order) const {
    auto at = order.begin();
    for (const std::string& stage : stages) {
      at = std::find(at, order.end(), stage);
      if (at == order.end()) return false;
    }
    return true;
  }
  /// Returns the largest step of the fraction.
  float largest_step() const {
    float largest = fractions.empty() ? 1.0F : fractions.front();
    for (std::size_t i = 1; i < fractions.size(); ++i)
      largest = std::max(largest, fractions[i] - fractions[i - 1]);
    return largest;
  }
};

/// Collects what a Progress is told, and cancels it after some of it.
class Watcher : public Progress::Observer {
 public:
  explicit Watcher(std::size_t cancel_after = SIZE_MAX) : left_(cancel_after) {}

  void on_fraction(float fraction) override {
    const std::lock_guard lock(mutex_);
    seen_.fractions.push_back(fraction);
    cancel_in_time();
  }
  void on_stage(std::string_view stage) override {
    const std::lock_guard lock(mutex_);
    if (seen_.stages.empty() || seen_.stages.back() != stage) seen_.stages.emplace_back(stage);
  }
  Progress& progress() { return progress_; }
  /// When `progress` was canceled.
  std::chrono::steady_clock::time_point cancelled_at() const { return cancelled_at_; }
  Watched seen() {
    std::ranges::sort(seen_.fractions);  // threads tell of two steps in any order
    seen_.at_end = progress_.fraction();
    return seen_;
  }

 private:
  void cancel_in_time() {
    if (left_-- > 0) return;
    cancelled_at_ = std::chrono::steady_clock::now();
    progress_.cancel();
    left_ = SIZE_MAX;
  }

  std::mutex mutex_;
  Watched seen_;
  std::size_t left_;
  std::chrono::steady_clock::time_point cancelled_at_;
  Progress progress_{this};
};

/// Runs an operation and watches it.
inline Watched watched(const std::function<void(Progress*)>& operation) {
  Watcher watcher;
  try {
    operation(&watcher.progress());
  } catch (const std::exception& error) {
    ADD_FAILURE() << error.what();
  }
  return watcher.seen();
}

/// Expects that the fraction ends at 1, and that the stages come in this order up to the last.
inline void expect_one_progress(const Watched& seen, const std::vector<std::string>& order) {
  EXPECT_EQ(seen.at_end, 1.0F);
  EXPECT_TRUE(seen.has_order(order)) << testing::PrintToString(seen.stages);
  ASSERT_FALSE(seen.stages.empty());
  EXPECT_EQ(seen.stages.back(), order.back());
  EXPECT_GE(seen.fractions.size(), 3U) << "hardly anything was reported";
}

/// Runs an operation several times, cancels each run after another of its reports, and expects that
/// it throws Cancelled or, as another thread may just finish the work, ends. `on_cancel` is called
/// after each canceled run. Prints how long the longest run went on after its cancellation.
inline void cancel_at_many_moments(const std::string& name,
                                   const std::function<void(Progress*)>& operation,
                                   const std::function<void()>& on_cancel = {}, int runs = 12) {
  using Clock = std::chrono::steady_clock;
  using Milliseconds = std::chrono::duration<double, std::milli>;
  const std::size_t reports = watched(operation).fractions.size();
  double most_ms = 0.0;
  int cancelled = 0;
  for (int run = 0; run < runs; ++run) {
    Watcher watcher(reports * static_cast<std::size_t>(run) / static_cast<std::size_t>(runs));
    try {
      operation(&watcher.progress());
      continue;
    } catch (const Cancelled&) {
      ++cancelled;
    }
    most_ms = std::max(most_ms, Milliseconds(Clock::now() - watcher.cancelled_at()).count());
    if (on_cancel) on_cancel();
  }
  EXPECT_GE(cancelled, runs / 2) << name;
  std::cout << name << ": " << reports << " reports; " << cancelled << " of " << runs
            << " runs canceled, at most " << most_ms << " ms late\n";
}

}  // namespace mesher::test
