#pragma once

#include <cstdint>

#include "engine/mesh/geomorph.h"

namespace mesher::progressive {

/// The way from the base of a progressive mesh to all its detail, and three measures of it:
///
/// - `time`, as GeomorphTime has it: split i grows while time goes from i to i + window;
/// - `grown`: how many splits have grown up, which is what a level is where nothing grows;
/// - `position`, 0 to 1, of a slider: the logarithm of the number of vertices, so that coarse
///   levels, which differ most, get as much room as fine ones.
///
/// The window is a share of the vertices that there are by then, at least one split: as wide for
/// the eye at a coarse level as at a fine one. Each measure grows with the others.
struct DetailRange {
  double base_vertices = 1.0;
  std::uint32_t splits = 0;
  double geomorph_range = 0.0;  ///< share of the vertices, 0 to kMaxGeomorphRange; 0: splits pop

  static constexpr double kMaxGeomorphRange = 0.5;

  /// Everything has grown.
  double end() const { return time_of_level(splits); }
  /// How many splits grow at a time. At least 1.
  double growing(double time) const;
  double grown(double time) const { return time - growing(time) + 1.0; }
  double time_of(double grown) const;
  /// The first at which a level's splits have all grown.
  double time_of_level(std::uint32_t level) const { return level == 0 ? 0.0 : time_of(level); }
  double position_of(double time) const;
  double time_at(double position) const;
  /// The level that is drawn then.
  std::uint32_t level(double time) const;
  GeomorphTime growth(double time) const;
};

}  // namespace mesher::progressive
