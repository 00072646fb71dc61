#include "app/document/progressive_view.h"

#include "app/document/automatic_level.h"
#include "app/document/stand_in.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace mesher::app {
namespace {

/// Times of preparing geomorphs of positions and of attributes, of measuring levels, and of the
/// stand-in, which only large models get.
constexpr double kLevelWeights[] = {0.5, 0.05, 0.45, 0.02};
// The distance to the automatic level decreases by a factor of e in this time.
constexpr double kTravelSeconds = 0.15;
// The level counts as reached within this distance, in positions of the slider.
constexpr double kArrived = 5e-4;

}  // namespace

DetailLevels detail_levels(progressive::Progressive&& progressive, Progress* progress) {
  DetailLevels levels;
  levels.mesh = std::move(progressive.mesh);
  levels.vertex_source = std::move(progressive.vertex_source);
  levels.face_source = std::move(progressive.face_source);
  levels.attributes = std::move(progressive.attributes);
  Stages stages(progress, kLevelWeights);
  stages.next("preparing geomorphs");
  levels.geomorph = progressive::Geomorph(levels.mesh, progress);
  stages.next();
  levels.attribute_morph = progressive::AttributeMorph(levels.attributes, progress);
  stages.next("measuring levels");
  levels.errors = progressive::LevelErrors(levels.mesh, progress);
  stages.next();
  if (levels.mesh.full_face_count() > kStandInFrom)
    levels.stand_in = level_as_stand_in(levels.mesh, progress);
  return levels;
}

void ProgressiveView::show(DetailLevels&& levels) {
  const bool was_at_end = !has_mesh_ || is_at_end();
  const double grown = has_mesh_ ? range().grown(time_) : 0.0;
  reader_.reset();
  levels_ = std::move(levels);
  has_mesh_ = has_geomorph_ = true;
  goal_.reset();
  set_time(was_at_end ? range().end() : range().time_of(grown));
}

void ProgressiveView::show(std::unique_ptr<progressive::PmReader> reader) {
  forget();
  reader_ = std::move(reader);
  has_mesh_ = follows_reader_ = true;
  reader_was_fed();
}

void ProgressiveView::reader_was_fed() {
  // What was read at once is small compared to what a large file becomes.
  if (!levels_.stand_in && mesh().mesh().face_count() >= kStandInFaces)
    levels_.stand_in = make_stand_in(mesh().mesh(), statistics(mesh().mesh()));
  set_time(follows_reader_ ? range().end() : time_);
}

void ProgressiveView::end_reading() {
  levels_.attributes = reader_->take_attributes();
  levels_.mesh = std::move(*reader_).take();
  reader_.reset();
  follow_level();
}

void ProgressiveView::forget() {
  reader_.reset();
  levels_ = {};
  has_mesh_ = has_geomorph_ = is_on_ = follows_reader_ = is_playing_ = false;
  time_ = 0.0;
  goal_.reset();
}

void ProgressiveView::turn(bool on) {
  is_on_ = on;
  is_playing_ = false;
}

progressive::DetailRange ProgressiveView::range() const {
  const bool morphs = settings_.geomorphs && has_geomorph_;
  return {.base_vertices = std::max(1.0, double(mesh().base_vertex_count())),
          .splits = mesh().split_count(),
          .geomorph_range = morphs ? std::clamp(double(settings_.geomorph_range), 0.0,
                                                progressive::DetailRange::kMaxGeomorphRange)
                                   : 0.0};
}

void ProgressiveView::set_time(double time) {
  time_ = std::clamp(time, 0.0, range().end());
  follow_level();
}

void ProgressiveView::follow_level() {
  mesh().go_to(range().level(time_));
  if (has_geomorph_) levels_.geomorph.follow(mesh());
  if (levels_.attributes.is_empty()) return;
  levels_.attributes.go_to(mesh().level());
  levels_.attribute_morph.follow(levels_.attributes);
}

void ProgressiveView::take_hold() {
  is_playing_ = settings_.is_automatic = follows_reader_ = false;
}

void ProgressiveView::move_to(double position) {
  take_hold();
  set_time(range().time_at(position));
}

void ProgressiveView::move_by(int splits) {
  take_hold();
  set_time(time_ + splits);
}

void ProgressiveView::move_to_level(std::uint32_t level) {
  take_hold();
  set_time(range().time_of_level(level));
}

void ProgressiveView::change(const ProgressiveSettings& settings) {
  if (settings == settings_) return;
  if (!has_mesh_) {
    settings_ = settings;
    return;
  }
  const bool was_at_end = is_at_end();
  const bool was_at_base = time_ == 0.0;
  const double grown = range().grown(time_);
  settings_ = settings;
  if (settings_.is_automatic) is_playing_ = follows_reader_ = false;
  if (!settings_.is_automatic) goal_.reset();
  if (was_at_base) return follow_level();
  set_time(was_at_end ? range().end() : range().time_of(grown));
}

void ProgressiveView::play(bool on) {
  if (on) {
    take_hold();
    is_rising_ = !is_at_end();
  }
  is_playing_ = on;
}

bool ProgressiveView::advance(double seconds, double pixels_per_unit) {
  if (!is_on_) return false;
  if (is_playing_) return swing(seconds);
  return settings_.is_automatic && has_geomorph_ && travel(seconds, pixels_per_unit);
}

bool ProgressiveView::swing(double seconds) {
  // One period goes up and down again: 0 to 1 rises, 1 to 2 falls.
  const double from = is_rising_ ? position() : 2.0 - position();
  const double to = std::fmod(from + seconds / std::max(double(settings_.seconds), 0.1), 2.0);
  is_rising_ = to < 1.0;
  set_time(range().time_at(is_rising_ ? to : 2.0 - to));
  return true;
}

bool ProgressiveView::travel(double seconds, double pixels_per_unit) {
  const progressive::DetailRange range = this->range();
  const auto grown =
      static_cast<std::uint32_t>(std::clamp(range.grown(time_), 0.0, double(range.splits)));
  goal_ = automatic_level(levels_.errors, goal_.value_or(grown), settings_.tolerance_px,
                          pixels_per_unit);
  const double goal = range.time_of_level(*goal_);
  if (time_ == goal) return false;
  const double position = range.position_of(time_);
  const double way = range.position_of(goal) - position;
  if (std::abs(way) <= kArrived) {
    set_time(goal);
    return true;  // this frame must still be drawn
  }
  set_time(range.time_at(position + way * -std::expm1(-seconds / kTravelSeconds)));
  return true;
}

void ProgressiveView::settle(double pixels_per_unit) {
  if (!is_on_ || is_playing_ || !settings_.is_automatic || !has_geomorph_) return;
  constexpr double kLong = 1e3;
  while (travel(kLong, pixels_per_unit)) {
  }
}

}  // namespace mesher::app
