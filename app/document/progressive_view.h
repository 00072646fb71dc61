#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "engine/core/option.h"
#include "engine/core/progress.h"
#include "engine/progressive/attribute_morph.h"
#include "engine/progressive/build.h"
#include "engine/progressive/codec/pm_read.h"
#include "engine/progressive/detail_range.h"
#include "engine/progressive/geomorph.h"
#include "engine/progressive/level_errors.h"

namespace mesher::app {

/// How progressive meshes are shown and built.
struct ProgressiveSettings {
  std::uint32_t base_faces = 0;   ///< of the base; 0: chosen by size and error (choose_base)
  bool geomorphs = true;          ///< vertices move to their new positions; otherwise they jump
  float geomorph_range = 0.125F;  ///< share of the vertices, see DetailRange
  bool colors_by_split_order = false;  ///< faces are colored by split order
  float seconds = 6.0F;                ///< duration of playback from the base to full detail
  bool is_automatic = false;           ///< the level follows from the screen-space error
  float tolerance_px = 1.0F;           ///< the largest screen-space error of the automatic level

  friend bool operator==(const ProgressiveSettings&, const ProgressiveSettings&) = default;
};
inline constexpr std::array kProgressiveOptions{
    Option<ProgressiveSettings>{
        .key = "base-faces",
        .label = "base faces",
        .help = "number of faces of the base, the coarsest level",
        .member = &ProgressiveSettings::base_faces,
        .special = {0.0,
                    "200, or an eighth of a small model; more if the base would otherwise "
                    "be further than 5 % of the diagonal from the model, or 0.5 % with seams"}},
    Option<ProgressiveSettings>{.key = "geomorphs",
                                .label = "geomorphs",
                                .help = "move vertices smoothly to their new positions",
                                .member = &ProgressiveSettings::geomorphs},
    Option<ProgressiveSettings>{
        .key = "geomorph-range",
        .label = "geomorph range",
        .help = "number of splits that are animated at a time, as a share of the vertices",
        .member = &ProgressiveSettings::geomorph_range,
        .least = 0.001,
        .most = progressive::DetailRange::kMaxGeomorphRange},
    Option<ProgressiveSettings>{.key = "split-colors",
                                .label = "split colors",
                                .help = "color faces by split order, from violet (first) to yellow",
                                .member = &ProgressiveSettings::colors_by_split_order},
    Option<ProgressiveSettings>{.key = "seconds",
                                .label = "seconds",
                                .help = "duration of playback from the base to full detail",
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

/// A progressive mesh and the data that is needed to show it.
struct DetailLevels {
  progressive::ProgressiveMesh mesh;
  progressive::Geomorph geomorph;
  progressive::LevelErrors errors;
  /// At the level of the mesh; empty if the model has none, or a file still arrives.
  progressive::ProgressiveAttributes attributes;
  progressive::AttributeMorph attribute_morph;
  /// The vertices and faces of the model that those of the mesh come from, as in Progressive. Empty
  /// if the mesh was read from a file.
  Array<Vertex> vertex_source;
  Array<Halfedge> face_source;
  /// Report of the simplification to the base; none if the mesh was read from a file.
  std::optional<simplify::SimplifyReport> report{};
  /// The options that it was built by, as words of an edit; empty if the mesh was read from a file.
  std::string built_by{};
  /// A level that any machine draws within a frame, for meshes that need one (kStandInFrom); else
  /// null.
  std::shared_ptr<const Mesh> stand_in{};
};

/// Computes what is needed to show a progressive mesh. O(F). Throws Cancelled.
DetailLevels detail_levels(progressive::Progressive&& progressive, Progress* progress);

/// The state of a progressive mesh on the screen: its level of detail, and the animation of that
/// level. It has no window, no GPU and no clock.
class ProgressiveView {
 public:
  // The mesh.

  /// Shows these levels, at the current level of detail, or at full detail if there was no mesh.
  void show(DetailLevels&& levels);
  /// Shows the splits that a reader has read, and follows it until a person changes the level.
  /// Splits are not animated until `show` provides a geomorph. Pre: the reader has the base.
  void show(std::unique_ptr<progressive::PmReader> reader);
  /// The reader, or null. It is fed at full detail; call `reader_was_fed` afterward, still there.
  progressive::PmReader* reader() { return reader_.get(); }
  void reader_was_fed();
  /// Keeps the mesh of the reader, which is not fed any more. Pre: there is a reader.
  void end_reading();
  /// Drops the mesh. The settings stay.
  void forget();

  bool has_mesh() const { return has_mesh_; }
  bool is_arriving() const { return reader_ != nullptr; }
  /// Pre: has_mesh().
  progressive::ProgressiveMesh& mesh() { return reader_ ? reader_->mesh() : levels_.mesh; }
  const progressive::ProgressiveMesh& mesh() const {
    return reader_ ? reader_->mesh() : levels_.mesh;
  }
  const DetailLevels& levels() const { return levels_; }
  /// For the GPU's mirror of the attributes, which clears their change log.
  progressive::ProgressiveAttributes& attributes() { return levels_.attributes; }
  /// A coarse level, to be shown while drawing the mesh would take too long; null: none was made.
  const std::shared_ptr<const Mesh>& stand_in() const { return levels_.stand_in; }
  bool has_geomorph() const { return has_geomorph_; }
  bool is_on() const { return is_on_; }
  /// Turns progressive mode on or off. Pre: has_mesh(), to turn it on.
  void turn(bool on);

  // The level of detail.

  double time() const { return time_; }
  progressive::DetailRange range() const;
  GeomorphTime growth() const { return range().growth(time_); }
  double position() const { return range().position_of(time_); }
  bool is_at_end() const { return time_ >= range().end(); }
  /// Moves to a position of the slider, as in DetailRange. This and the next two functions end
  /// playing, the automatic level, and following the reader.
  void move_to(double position);
  /// Moves by single splits.
  void move_by(int splits);
  /// Moves to a level at which all its splits are finished.
  void move_to_level(std::uint32_t level);

  // Animation.

  const ProgressiveSettings& settings() const { return settings_; }
  /// Changes the settings. Finished splits stay finished.
  void change(const ProgressiveSettings& settings);
  bool is_playing() const { return is_playing_; }
  /// Starts or stops playing back and forth between the base and full detail. It starts upward, or
  /// downward at full detail. Ends the automatic level.
  void play(bool on);
  /// Advances the animation by `seconds`, with model units of this size on the screen. Returns
  /// whether the animation continues.
  bool advance(double seconds, double pixels_per_unit);
  /// Moves to the automatic level at once, if the level is automatic.
  void settle(double pixels_per_unit);

 private:
  void set_time(double time);
  void take_hold();
  void follow_level();
  bool travel(double seconds, double pixels_per_unit);
  bool swing(double seconds);

  ProgressiveSettings settings_;
  DetailLevels levels_;
  std::unique_ptr<progressive::PmReader> reader_;
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
