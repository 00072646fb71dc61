#pragma once

#include <cstdint>
#include <string>

#include "app/cli/lods_command.h"
#include "app/document/json.h"
#include "engine/simplify/options.h"

namespace mesher::app {

/// What `lods` reports of a level. In a scene, a mesh counts as often as it is shown.
struct LodLevel {
  double ratio = 1.0;
  double coverage = 0.0;
  std::uint64_t asked_faces = 0;
  std::uint64_t vertices = 0;
  std::uint64_t faces = 0;
  /// Root mean square distance from the input, in its units; negative if this or a coarser level is
  /// near.
  double error = -1.0;
};

/// Returns the options that simplify a mesh of `faces` faces to a level of `target` faces. Ratios
/// that the person gave are reached at any error; by default, simplification stops at
/// kFarFromInput. `diagonal` is that of the input, in units of the mesh.
simplify::SimplifyOptions lod_options(const LodArguments& arguments, std::uint32_t target,
                                      std::uint32_t faces, double diagonal);

/// "level 1: 500 vertices, 998 faces, for a coverage of at least 0.25; asked for 900 faces". `why`
/// follows if the level has more faces than were asked for.
std::string level_text(std::size_t index, const LodLevel& level, const std::string& why = "");

/// Prints a warning on stderr if a level is far from the input. `diagonal` is the input's.
void warn_if_far(std::size_t index, const LodLevel& level, double diagonal);

Json level_json(const LodLevel& level);

}  // namespace mesher::app
