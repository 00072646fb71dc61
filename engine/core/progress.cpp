#include "engine/core/progress.h"

#include <exception>
#include <numeric>

#include "engine/core/assert.h"
#include "engine/core/error.h"

namespace mesher {

std::string Progress::stage() const {
  const std::lock_guard lock(mutex_);
  return stage_;
}

void Progress::name_stage(std::string_view stage) {
  {
    const std::lock_guard lock(mutex_);
    stage_ = stage;
  }
  if (observer_ != nullptr) observer_->on_stage(stage);
}

bool Progress::cancel() {
  State expected = State::running;
  state_.compare_exchange_strong(expected, State::cancelled);
  return expected != State::sealed;
}

void Progress::seal() {
  if (is_cancelled()) throw Cancelled();
  State expected = State::running;
  state_.compare_exchange_strong(expected, State::sealed);
  if (expected == State::cancelled) throw Cancelled();
}

void Progress::set(float fraction) {
  // A finished stage ends exactly where the next one begins.
  const double at =
      fraction < 1.0F ? part_.begin + double{fraction} * (part_.end - part_.begin) : part_.end;
  const auto wanted = static_cast<float>(at);
  float now = fraction_.load(std::memory_order_relaxed);
  while (now < wanted && !fraction_.compare_exchange_weak(now, wanted, std::memory_order_relaxed)) {
  }
  if (observer_ != nullptr && now < wanted) observer_->on_fraction(wanted);
}

Stages::Stages(Progress* progress, std::span<const double> weights)
    : progress_(progress), exceptions_(std::uncaught_exceptions()) {
  if (progress == nullptr) return;
  whole_ = progress->part_;
  const double sum = std::accumulate(weights.begin(), weights.end(), 0.0);
  double before = 0.0;
  for (const double weight : weights) {
    before += weight;
    ends_.push_back(sum > 0.0 ? whole_.begin + before / sum * (whole_.end - whole_.begin)
                              : whole_.end);
  }
  if (!ends_.empty()) ends_.back() = whole_.end;  // free of rounding
}

Stages::~Stages() {
  if (progress_ == nullptr) return;
  progress_->part_ = whole_;
  if (std::uncaught_exceptions() == exceptions_) progress_->set(1.0F);
}

void Stages::next(std::string_view name) {
  if (progress_ == nullptr) return;
  MESHER_ASSERT(started_ < ends_.size());
  check_cancelled(progress_);
  progress_->part_ = {started_ == 0 ? whole_.begin : ends_[started_ - 1], ends_[started_]};
  ++started_;
  progress_->set(0.0F);
  if (!name.empty()) progress_->name_stage(name);
}

OpenStages::OpenStages(Progress* progress, double share)
    : progress_(progress), share_(share), exceptions_(std::uncaught_exceptions()) {
  if (progress == nullptr) return;
  whole_ = progress->part_;
  end_ = whole_.begin;
}

OpenStages::~OpenStages() {
  if (progress_ == nullptr) return;
  progress_->part_ = whole_;
  if (std::uncaught_exceptions() == exceptions_) progress_->set(1.0F);
}

void OpenStages::next() {
  if (progress_ == nullptr) return;
  check_cancelled(progress_);
  progress_->part_ = {end_, end_ + share_ * (whole_.end - end_)};
  end_ = progress_->part_.end;
  progress_->set(0.0F);
}

void report(Progress* progress, float fraction) {
  check_cancelled(progress);
  if (progress != nullptr) progress->set(fraction);
}

void check_cancelled(const Progress* progress) {
  const bool is_over = progress == nullptr ? TimeLimit::is_over() : progress->is_cancelled();
  if (is_over) throw Cancelled();
}

void seal(Progress* progress) {
  check_cancelled(progress);
  if (progress != nullptr) progress->seal();
}

void begin_stage(Progress* progress, std::string_view stage) {
  check_cancelled(progress);
  if (progress != nullptr) progress->name_stage(stage);
}

}  // namespace mesher
