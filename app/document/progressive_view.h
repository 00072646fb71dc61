#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>

#include "engine/core/option.h"
#include "engine/core/progress.h"
#include "engine/progressive/build.h"
#include "engine/progressive/detail_range.h"
#include "engine/progressive/geomorph.h"
#include "engine/progressive/level_errors.h"
#include "engine/progressive/pm_read.h"

namespace mesher::app {

/// How progressive meshes are shown and built.
struct ProgressiveSettings {
  std::uint32_t base_faces = 0;   ///< of the base; 0: chosen by size and error (choose_base)
  bool geomorphs = true;          ///< vertices move to their new positions; otherwise they jump
  float geomorph_range = 0.125F;  ///< share of the vertices, see DetailRange
  bool colors_by_split_order = false;  ///< faces are colored by split order
  float seconds = 6.0F;                ///< duration of playing from one end to the other
  bool is_automatic = false;           ///< the level follows from the screen-space error
  float tolerance_px = 1.0F;           ///< the largest screen-space error of the automatic level

  friend bool operator==(const ProgressiveSettings&, const ProgressiveSettings&) = default;
};
inline constexpr std::array kProgressiveOptions{
    Option<ProgressiveSettings>{
        .key = "base-faces",
        .label = "base faces",
        .help = "faces of the coarsest level",
        .member = &ProgressiveSettings::base_faces,
        .special = {0.0,
                    "200, or an eighth of a small model; more where the base would otherwise "
                    "be further than 5 % of the diagonal from the model"}},
    Option<ProgressiveSettings>{.key = "geomorphs",
                                .label = "geomorphs",
                                .help = "move vertices smoothly to their new positions",
                                .member = &ProgressiveSettings::geomorphs},
    Option<ProgressiveSettings>{
        .key = "geomorph-range",
        .label = "range",
        .help = "number of splits that are animated at a time, as a share of the vertices",
        .member = &ProgressiveSettings::geomorph_range,
        .least = 0.001,
        .most = DetailRange::kMaxGeomorphRange},
    Option<ProgressiveSettings>{.key = "split-colors",
                                .label = "split order",
                                .help = "color faces by split order, from violet (first) to yellow",
                                .member = &ProgressiveSettings::colors_by_split_order},
    Option<ProgressiveSettings>{.key = "seconds",
                                .label = "duration",
                                .help = "duration of playing from one end to the other",
                                .member = &ProgressiveSettings::seconds,
                                .unit = "s",
                                .least = 1.0,
                                .most = 60.0},
    Option<ProgressiveSettings>{
        .key = "automatic",
        .label = "automatic",
        .help = "show the coarsest level whose screen-space error is within the tolerance",
        .member = &ProgressiveSettings::is_automatic},
    Option<ProgressiveSettings>{.key = "tolerance",
                                .label = "tolerance",
                                .help = "largest screen-space error of the automatic level",
                                .member = &ProgressiveSettings::tolerance_px,
                                .unit = "px",
                                .least = 0.1,
                                .most = 20.0},
};

/// A progressive mesh and all that is needed to look at it.
struct DetailLevels {
  ProgressiveMesh mesh;
  Geomorph geomorph;
  LevelErrors errors;
  /// Where vertices and faces come from, as in Progressive; empty where they were not made from a
  /// model.
  Array<Vertex> vertex_source;
  Array<Halfedge> face_source;
  /// Of the simplification that led to the base; none where it was not made from a model.
  std::optional<SimplifyReport> report{};
};

/// All that a progressive mesh needs to be looked at. O(F). Throws Cancelled.
DetailLevels detail_levels(Progressive&& progressive, Progress* progress);

/// A progressive mesh as it is looked at: how far it is refined, and how that changes by itself.
/// No window, no GPU, no clock.
class ProgressiveView {
 public:
  // What is looked at.

  /// Shows these levels, refined as far as it was, or wholly where there was nothing.
  void show(DetailLevels&& levels);
  /// Shows what a reader has so far, and from now on follows what it reads until a person moves it.
  /// Splits pop until `show` brings a geomorph. Pre: it has a base.
  void show(std::unique_ptr<PmReader> reader);
  /// The reader is about to be fed (which it does at full detail), or has been.
  PmReader* reader() { return reader_.get(); }
  void reader_was_fed();
  /// The reader has read all it will: its mesh stays. Pre: there is a reader.
  void end_reading();
  /// Nothing is looked at any more. Settings stay.
  void forget();

  bool has_mesh() const { return has_mesh_; }
  bool is_arriving() const { return reader_ != nullptr; }
  /// Pre: has_mesh().
  ProgressiveMesh& mesh() { return reader_ ? reader_->mesh() : levels_.mesh; }
  const ProgressiveMesh& mesh() const { return reader_ ? reader_->mesh() : levels_.mesh; }
  const DetailLevels& levels() const { return levels_; }
  bool has_geomorph() const { return has_geomorph_; }
  bool is_on() const { return is_on_; }
  /// Pre: has_mesh() where it is turned on.
  void turn(bool on);

  // How far it is refined.

  double time() const { return time_; }
  DetailRange range() const;
  GeomorphTime growth() const { return range().growth(time_); }
  double position() const { return range().position_of(time_); }
  bool is_at_end() const { return time_ >= range().end(); }
  /// Whoever moves it by hand ends what moves it by itself. Positions as in DetailRange.
  void move_to(double position);
  /// By single splits.
  void move_by(int splits);
  /// To a level with all its splits grown.
  void move_to_level(std::uint32_t level);

  // By itself.

  const ProgressiveSettings& settings() const { return settings_; }
  /// What has grown stays grown.
  void change(const ProgressiveSettings& settings);
  bool is_playing() const { return is_playing_; }
  /// To and fro between the ends; first up, from the end down. Ends the automatic level.
  void play(bool on);
  /// So much time has passed, and the screen shows a model unit so large. Returns whether it moves
  /// on by itself.
  bool advance(double seconds, double pixels_per_unit);
  /// To where it will come to rest, if it will.
  void settle(double pixels_per_unit);

 private:
  void set_time(double time);
  void take_hold();
  void follow_level();
  bool travel(double seconds, double pixels_per_unit);
  bool swing(double seconds);

  ProgressiveSettings settings_;
  DetailLevels levels_;
  std::unique_ptr<PmReader> reader_;
  bool has_mesh_ = false;
  bool has_geomorph_ = false;
  bool is_on_ = false;
  bool follows_reader_ = false;
  bool is_playing_ = false;
  bool is_rising_ = true;
  double time_ = 0.0;
  std::optional<std::uint32_t> goal_;  ///< the automatic level
};

}  // namespace mesher::app
