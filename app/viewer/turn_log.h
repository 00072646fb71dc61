#pragma once

#include <chrono>
#include <filesystem>
#include <fstream>

#include "engine/core/job.h"

namespace mesher::app {

/// Writes what each turn of a window's loop took, one line of JSON per turn. Benchmarks read from
/// it how long the program itself makes a person wait:
///
///     {"end_s":12.3,"own_ms":4.5,"cpu_ms":4.2,"waited_ms":9.8,"drew":true,"job":null,"fraction":null}
///
/// `end_s` is the time of the system's monotonic clock. `own_ms` is the time from the first event
/// of the turn, or from the end of the sleep, to the end of the turn, without `waited_ms`: waiting
/// for the GPU to finish earlier frames, and presenting. `cpu_ms` is what of it the main thread
/// computed; it does not grow if other programs use the processor. `job` and `fraction` are what
/// the status line shows.
class TurnLog {
 public:
  /// An empty path: writes nothing. Throws OutputError if the file cannot be created.
  explicit TurnLog(const std::filesystem::path& file);

  /// Call when a sleep has ended, and at each event. Only the first call of a turn counts.
  void begin();
  /// Call before and after a wait for the GPU.
  void begin_wait();
  void end_wait();
  /// Ends the turn. `job`: null: none is shown. Throws OutputError.
  void end(bool drew, const Job* job);

 private:
  using Clock = std::chrono::steady_clock;

  std::filesystem::path file_;
  std::ofstream out_;
  bool is_in_turn_ = false;
  Clock::time_point begin_;
  double cpu_begin_s_ = 0.0;
  Clock::time_point wait_begin_;
  double cpu_wait_begin_s_ = 0.0;
  double waited_s_ = 0.0;
  double cpu_waited_s_ = 0.0;
};

}  // namespace mesher::app
