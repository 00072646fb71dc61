#pragma once

#include <condition_variable>
#include <mutex>
#include <thread>

#include "engine/core/progress.h"

namespace mesher::app {

/// Shows what a Progress says on stderr, ten times a second, where stderr is a terminal and the
/// work takes longer than a moment; wipes the line at the end. Otherwise does nothing.
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
