#pragma once

#include <condition_variable>
#include <mutex>
#include <thread>

#include "engine/core/progress.h"

namespace mesher::app {

/// Shows a Progress on stderr, ten times per second, if stderr is a terminal and the work takes
/// longer than a moment. Erases the line at the end.
class ProgressLine {
 public:
  explicit ProgressLine(bool is_wanted);
  ~ProgressLine();
  ProgressLine(const ProgressLine&) = delete;
  ProgressLine& operator=(const ProgressLine&) = delete;

  Progress* progress() { return &progress_; }

 private:
  void run();

  Progress progress_;
  std::mutex mutex_;
  std::condition_variable ended_;
  bool is_over_ = false;
  std::thread thread_;
};

}  // namespace mesher::app
