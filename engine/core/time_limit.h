#pragma once

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <mutex>
#include <thread>

namespace mesher {

/// Limits the time of the whole process while it lives. Once the time is over, every Progress is
/// canceled, also operations without one (check_cancelled, report), so that they end as if a person
/// had canceled them: with Cancelled, and without a trace. Files that are being renamed are
/// finished.
///
/// What does not look at its progress soon enough is ended after a grace period, with
/// ExitCode::timed_out. Child processes end with this one. Pre: no other TimeLimit is alive.
class TimeLimit {
 public:
  /// `seconds`: of wall-clock time; 0: no limit. `grace`: time to end in good order. `clean_up`:
  /// called before the end without good order; may be null.
  explicit TimeLimit(double seconds,
                     std::chrono::milliseconds grace = std::chrono::milliseconds(2000),
                     void (*clean_up)() = nullptr);
  ~TimeLimit();
  TimeLimit(const TimeLimit&) = delete;
  TimeLimit& operator=(const TimeLimit&) = delete;

  /// Returns whether the time is over. Cost: a relaxed load.
  static bool is_over() { return is_over_.load(std::memory_order_relaxed); }

 private:
  void run(double seconds, std::chrono::milliseconds grace, void (*clean_up)());

  static std::atomic<bool> is_over_;
  std::mutex mutex_;
  std::condition_variable ended_;
  bool has_ended_ = false;
  std::thread thread_;
};

}  // namespace mesher
