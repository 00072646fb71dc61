#include "app/cli/progress_line.h"

#include <fmt/format.h>
#include <unistd.h>

#include <chrono>
#include <cstdio>

namespace mesher::app {

ProgressLine::ProgressLine(bool is_wanted) {
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
  for (auto pause = 300ms; !ended_.wait_for(lock, pause, [this] { return is_over_; });
       pause = 100ms) {
    // Rounded down, because 100 % means that the work is done.
    const int percent = static_cast<int>(100.0F * progress_.fraction());
    const std::string text = fmt::format("\r\033[K{} {} %", progress_.stage(), percent);
    std::fputs(text.c_str(), stderr);
    std::fflush(stderr);
    has_written = true;
  }
  if (has_written) std::fputs("\r\033[K", stderr);
}

}  // namespace mesher::app
