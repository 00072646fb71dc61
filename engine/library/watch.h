#pragma once

#include <mesher/progress.h>

#include <mutex>
#include <string>

#include "engine/core/progress.h"

namespace mesher {

/// Passes the progress of an operation on to a callback of the face, one call at a time.
class Watch : private Progress::Observer {
 public:
  /// `callback` may be empty, and must outlive this.
  explicit Watch(const ProgressCallback& callback) : callback_(callback), progress_(this) {}

  /// Returns what the engine reports to; null: nobody is told.
  Progress* progress() { return callback_ ? &progress_ : nullptr; }

 private:
  void on_fraction(float fraction) override;
  void on_stage(std::string_view stage) override;
  void tell();

  const ProgressCallback& callback_;
  Progress progress_;
  std::mutex mutex_;  ///< of all below, and of calls
  float fraction_ = 0.0F;
  float told_ = -1.0F;
  std::string stage_;
};

}  // namespace mesher
