#include "app/cli/progress_line.h"

#include <unistd.h>

#include <cstdio>
#include <utility>

#include "engine/core/time_left.h"

namespace mesher::app {

ProgressLine::ProgressLine(bool is_wanted, std::string subject) : subject_(std::move(subject)) {
  if (is_wanted && isatty(STDERR_FILENO) == 1) thread_ = std::thread([this] { run(); });
}

ProgressLine::~ProgressLine() {
  if (!thread_.joinable()) return;
  {
    const std::lock_guard lock(mutex_);
    is_over_ = true;
  }
  ended_.notify_one();
  thread_.join();
}

void ProgressLine::run() {
  using namespace std::chrono_literals;
  std::unique_lock lock(mutex_);
  bool has_written = false;
  TimeLeft time_left;
  const std::string start = subject_.empty() ? "\r\033[K" : "\r\033[K" + subject_ + ": ";
  for (auto pause = 300ms; !ended_.wait_for(lock, pause, [this] { return is_over_; });
       pause = 100ms) {
    const double fraction = double{progress_.fraction()};
    time_left.update(
        std::chrono::duration<double>(std::chrono::steady_clock::now() - begin_).count(), fraction);
    const std::string text = start + progress_text(progress_.stage(), fraction, time_left);
    std::fputs(text.c_str(), stderr);
    std::fflush(stderr);
    has_written = true;
  }
  if (has_written) std::fputs("\r\033[K", stderr);
}

}  // namespace mesher::app
