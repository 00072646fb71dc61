#include "engine/core/time_left.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace mesher {
namespace {

constexpr double kMinute = 60.0;
constexpr double kHour = 3600.0;
/// The speed is averaged over this part of the elapsed time, and over at least so many seconds.
constexpr double kMemory = 0.5;
constexpr double kLeastMemorySeconds = 3.0;
/// Changes of the shown time are at least this far apart.
constexpr double kSecondsBetweenChanges = 1.0;
/// By how much the estimate must exceed the shown time before that grows.
constexpr double kClearlyLarger = 1.3;

double rounded_to(double step, double seconds) {
  return step * std::round(seconds / step);
}

}  // namespace

double spoken_seconds(double seconds) {
  // The first limits are where the next coarser step begins to round to.
  if (seconds < 9.5) return std::max(1.0, rounded_to(1.0, seconds));
  if (seconds < 27.5) return rounded_to(5.0, seconds);
  if (seconds < 55.0) return rounded_to(10.0, seconds);
  if (seconds < 9.5 * kMinute) return std::max(kMinute, rounded_to(kMinute, seconds));
  if (seconds < 57.5 * kMinute) return rounded_to(5.0 * kMinute, seconds);
  return std::max(kHour, rounded_to(0.5 * kHour, seconds));
}

std::string time_left_text(double spoken_seconds) {
  if (spoken_seconds < kMinute) return fmt::format("about {:.0f} s left", spoken_seconds);
  if (spoken_seconds < kHour) return fmt::format("about {:.0f} min left", spoken_seconds / kMinute);
  return fmt::format("about {:g} h left", spoken_seconds / kHour);
}

void TimeLeft::update(double elapsed_s, double fraction) {
  if (elapsed_s < elapsed_) *this = TimeLeft();
  follow(elapsed_s, fraction);
  const bool is_stalled = elapsed_s - grown_at_ > kStallSeconds;
  is_known_ = elapsed_s >= kLeastSeconds && fraction >= kLeastFraction && fraction < 1.0 &&
              !is_stalled && recent_fraction_ > 0.0;
  if (is_known_) {
    show(elapsed_s, (1.0 - fraction) * recent_seconds_ / recent_fraction_);
  } else {
    shown_ = 0.0;
    larger_since_ = -1.0;
  }
}

void TimeLeft::follow(double elapsed_s, double fraction) {
  const double seconds = elapsed_s - elapsed_;
  const double growth = std::max(0.0, fraction - fraction_);
  const double fade = std::exp(-seconds / std::max(kLeastMemorySeconds, kMemory * elapsed_s));
  recent_fraction_ = fade * recent_fraction_ + growth;
  recent_seconds_ = fade * recent_seconds_ + seconds;
  if (growth > 0.0) grown_at_ = elapsed_s;
  elapsed_ = elapsed_s;
  fraction_ = std::max(fraction_, fraction);
}

void TimeLeft::show(double elapsed_s, double left) {
  const double spoken = spoken_seconds(left);
  if (shown_ > 0.0 && elapsed_s - shown_at_ < kSecondsBetweenChanges) return;
  if (left <= kClearlyLarger * shown_) larger_since_ = -1.0;
  if (shown_ > 0.0 && spoken >= shown_) {
    if (left <= kClearlyLarger * shown_ || spoken == shown_) return;
    if (larger_since_ < 0.0) larger_since_ = elapsed_s;
    if (elapsed_s - larger_since_ < kPatienceSeconds) return;
  }
  larger_since_ = -1.0;
  shown_ = spoken;
  shown_at_ = elapsed_s;
}

std::string TimeLeft::text() const {
  return is_known_ ? time_left_text(shown_) : std::string();
}

std::string progress_text(const std::string& stage, double fraction, const TimeLeft& left) {
  const std::string time = left.text();
  return fmt::format("{} {:.0f} %{}{}", stage, std::floor(100.0 * fraction),
                     time.empty() ? "" : ", ", time);
}

}  // namespace mesher
