#pragma once

#include <chrono>
#include <condition_variable>
#include <mutex>
#include <string>
#include <thread>

#include "engine/core/progress.h"

namespace mesher::app {

/// Shows a Progress on stderr, ten times per second, if stderr is a terminal and the work takes
/// longer than a moment: "knot.obj: reading 42 %, about 3 s left". Erases the line at the end.
class ProgressLine {
 public:
  /// `subject`: what is worked on ("knot.obj"); may be empty.
  explicit ProgressLine(bool is_wanted, std::string subject = {});
  ~ProgressLine();
  ProgressLine(const ProgressLine&) = delete;
  ProgressLine& operator=(const ProgressLine&) = delete;

  Progress* progress() { return &progress_; }

 private:
  void run();

  std::string subject_;
  std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
  Progress progress_;
  std::mutex mutex_;
  std::condition_variable ended_;
  bool is_over_ = false;
  std::thread thread_;
};

}  // namespace mesher::app
