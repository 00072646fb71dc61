#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "app/cli/lods_command.h"
#include "app/document/json.h"
#include "engine/io/atomic_file.h"
#include "engine/simplify/cards.h"
#include "engine/simplify/options.h"

namespace mesher::app {

/// What `lods` reports of a level. In a scene, a mesh counts as often as it is shown. Lengths are
/// in units of the model.
struct LodLevel {
  double ratio = 1.0;  ///< asked for, or that of the level if an error chose it
  double coverage = 0.0;
  std::uint64_t asked_faces = 0;  ///< 0: an error chose the level
  std::uint64_t vertices = 0;
  std::uint64_t faces = 0;
  /// Root mean square distance from the model: SimplifyReport::estimated_error, or
  /// distance_from_input for levels of a progressive mesh.
  double rms = 0.0;
  double bound = -1.0;  ///< certified bound of the distance; negative: not known
  simplify::ThinnedCards cards;

  /// Returns the error that decides when a level is shown: the bound, or else the RMS distance.
  double error() const { return bound >= 0.0 ? bound : rms; }
};

/// The levels, and the screen that tells errors in pixels.
struct LodReport {
  std::vector<LodLevel> levels;
  ScreenArguments screen;
  double diagonal = 0.0;  ///< of the model

  double pixels(double error) const { return pixels_per_unit(screen, diagonal) * error; }
  bool is_far(const LodLevel& level) const;
};

/// Returns the options that simplify a mesh of `faces` faces to a level of `target` faces. Ratios
/// that the person gave are reached at any error; by default, simplification stops at
/// kFarFromInput. `diagonal` is that of the input, in units of the mesh.
simplify::SimplifyOptions lod_options(const LodArguments& arguments, std::uint32_t target,
                                      std::uint32_t faces, double diagonal);
/// Returns the options that simplify to the fewest faces within this error, in units of the mesh.
simplify::SimplifyOptions lod_options_within(const LodArguments& arguments, double max_error);

/// Sets the coverage of the levels, and the ratio of those that an error chose. `faces`: those of
/// the model.
void set_coverage(std::vector<LodLevel>& levels, const LodArguments& arguments,
                  std::uint64_t faces);

/// "level 1: 500 vertices, 998 faces, for a coverage of at least 0.25, error 0.02 (RMS), 1.5
/// pixels; asked for 900 faces". `why` follows if the level has more faces than were asked for.
std::string level_text(const LodReport& report, std::size_t index, const std::string& why = "");

/// Prints what else there is to say of a level on stderr: a warning if it is far from the input,
/// and what became of loose cards.
void say_rest_of_level(const LodReport& report, std::size_t index);

Json level_json(const LodReport& report, std::size_t index);

/// Writes what a program needs to choose between files of levels. Does not commit. `files`: one per
/// level, beside the manifest.
void write_manifest(io::AtomicFile& file, const LodReport& report,
                    std::span<const std::filesystem::path> files,
                    const std::filesystem::path& input);

}  // namespace mesher::app
