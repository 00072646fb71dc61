#pragma once

#include <atomic>
#include <mutex>
#include <string>
#include <string_view>

namespace mesher {

/// The progress of a long operation, and whether it has been canceled. The worker writes the
/// progress; another thread reads it and may cancel. Passed as a pointer; null: nobody is watching.
class Progress {
 public:
  /// Starts a stage. `stage` is text for the user ("reading bunny.obj").
  void begin(std::string_view stage);
  /// Sets the finished fraction of the stage, 0 to 1.
  void set(float fraction) { fraction_.store(fraction, std::memory_order_relaxed); }
  float fraction() const { return fraction_.load(std::memory_order_relaxed); }
  std::string stage() const;

  void cancel() { cancelled_.store(true, std::memory_order_relaxed); }
  bool is_cancelled() const { return cancelled_.load(std::memory_order_relaxed); }

 private:
  std::atomic<float> fraction_{0.0F};
  std::atomic<bool> cancelled_{false};
  mutable std::mutex mutex_;
  std::string stage_;
};

/// Sets the fraction, or throws Cancelled if `progress` was canceled. Does nothing if it is null.
/// Call it between units of work, not in inner loops.
void report(Progress* progress, float fraction);

/// Starts a stage, or throws Cancelled if `progress` was canceled. Does nothing if it is null.
void begin_stage(Progress* progress, std::string_view stage);

}  // namespace mesher
