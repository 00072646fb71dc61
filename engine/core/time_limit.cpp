#include "engine/core/time_limit.h"

#include <fmt/format.h>
#include <unistd.h>

#include <string>

#include "engine/core/error.h"
#include "engine/core/text.h"

namespace mesher {

std::atomic<bool> TimeLimit::is_over_{false};

TimeLimit::TimeLimit(double seconds, std::chrono::milliseconds grace, void (*clean_up)()) {
  if (seconds > 0.0)
    thread_ = std::thread([this, seconds, grace, clean_up] { run(seconds, grace, clean_up); });
}

TimeLimit::~TimeLimit() {
  {
    const std::lock_guard lock(mutex_);
    has_ended_ = true;
  }
  ended_.notify_one();
  if (thread_.joinable()) thread_.join();
  is_over_ = false;
}

void TimeLimit::run(double seconds, std::chrono::milliseconds grace, void (*clean_up)()) {
  std::unique_lock lock(mutex_);
  const auto has_ended = [this] { return has_ended_; };
  if (ended_.wait_for(lock, std::chrono::duration<double>(seconds), has_ended)) return;
  is_over_ = true;
  if (ended_.wait_for(lock, grace, has_ended)) return;
  if (clean_up != nullptr) clean_up();
  // The thread that works may hold any lock, so this is done without the C++ library's streams.
  const std::string line =
      fmt::format("mesher: stopped after {} (--timeout)\n", seconds_text(seconds));
  static_cast<void>(!::write(STDERR_FILENO, line.data(), line.size()));
  ::_exit(static_cast<int>(ExitCode::timed_out));
}

}  // namespace mesher
