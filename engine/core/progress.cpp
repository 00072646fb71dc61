#include "engine/core/progress.h"

#include "engine/core/error.h"

namespace mesher {

void Progress::begin(std::string_view stage) {
  const std::lock_guard lock(mutex_);
  stage_ = stage;
  set(0.0F);
}

std::string Progress::stage() const {
  const std::lock_guard lock(mutex_);
  return stage_;
}

void report(Progress* progress, float fraction) {
  if (progress == nullptr) return;
  if (progress->is_cancelled()) throw Cancelled();
  progress->set(fraction);
}

void begin_stage(Progress* progress, std::string_view stage) {
  if (progress == nullptr) return;
  if (progress->is_cancelled()) throw Cancelled();
  progress->begin(stage);
}

}  // namespace mesher
