#include "app/viewer/turn_log.h"

#include <ctime>

#include "app/document/json.h"
#include "engine/core/error.h"

namespace mesher::app {
namespace {

/// Processor time of this thread.
double thread_cpu_s() {
  timespec time{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

double seconds(std::chrono::steady_clock::duration time) {
  return std::chrono::duration<double>(time).count();
}

}  // namespace

TurnLog::TurnLog(const std::filesystem::path& file) : file_(file) {
  if (file.empty()) return;
  out_.open(file);
  if (!out_) throw OutputError(file.string(), "cannot be written");
}

void TurnLog::begin() {
  if (!out_.is_open() || is_in_turn_) return;
  is_in_turn_ = true;
  waited_s_ = cpu_waited_s_ = 0.0;
  cpu_begin_s_ = thread_cpu_s();
  begin_ = Clock::now();
}

void TurnLog::begin_wait() {
  if (!is_in_turn_) return;
  cpu_wait_begin_s_ = thread_cpu_s();
  wait_begin_ = Clock::now();
}

void TurnLog::end_wait() {
  if (!is_in_turn_) return;
  waited_s_ += seconds(Clock::now() - wait_begin_);
  cpu_waited_s_ += thread_cpu_s() - cpu_wait_begin_s_;
}

void TurnLog::end(bool drew, const Job* job) {
  if (!is_in_turn_) return;
  is_in_turn_ = false;
  const Clock::time_point end = Clock::now();
  const Json line{
      {"end_s", seconds(end.time_since_epoch())},
      {"own_ms", 1000.0 * (seconds(end - begin_) - waited_s_)},
      {"cpu_ms", 1000.0 * (thread_cpu_s() - cpu_begin_s_ - cpu_waited_s_)},
      {"waited_ms", 1000.0 * waited_s_},
      {"drew", drew},
      {"job", job == nullptr ? Json() : Json(job->title())},
      {"fraction", job == nullptr ? Json() : Json(job->progress().fraction())},
  };
  out_ << to_text(line, -1) << std::endl;  // flushed, because a benchmark may be waiting for it
  if (!out_) throw OutputError(file_.string(), "cannot be written");
}

}  // namespace mesher::app
