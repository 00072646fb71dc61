#pragma once

#include <atomic>
#include <mutex>
#include <string>
#include <string_view>

namespace mesher {

/// How far a long piece of work has come, and whether it is still wanted. Written by the worker,
/// read and cancelled by another thread. Passed as a pointer; null means nobody is watching.
class Progress {
 public:
  /// Names the stage that begins, as a person would read it ("reading bunny.obj").
  void begin(std::string_view stage);
  /// Fraction of the stage that is done, 0 to 1.
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

/// Throws Cancelled where `progress` is watched and cancelled; otherwise notes the fraction.
/// Call between pieces of work, not in inner loops.
void report(Progress* progress, float fraction);

/// Names a stage where anybody is watching; throws Cancelled where the work is not wanted any more.
void begin_stage(Progress* progress, std::string_view stage);

}  // namespace mesher
