#include "engine/library/watch.h"

namespace mesher {
namespace {

/// Calls per operation are worth less than the locks that they take.
constexpr float kSmallestStep = 0.005F;

}  // namespace

void Watch::on_fraction(float fraction) {
  const std::lock_guard lock(mutex_);
  if (fraction <= fraction_) return;
  fraction_ = fraction;
  if (fraction_ - told_ >= kSmallestStep || fraction_ >= 1.0F) tell();
}

void Watch::on_stage(std::string_view stage) {
  const std::lock_guard lock(mutex_);
  if (stage_ == stage) return;
  stage_ = stage;
  tell();
}

void Watch::tell() {
  told_ = fraction_;
  if (!callback_(fraction_, stage_)) progress_.cancel();
}

}  // namespace mesher
