#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "engine/analysis/attributed_surface.h"
#include "engine/analysis/flipped_uvs.h"
#include "engine/analysis/spread.h"
#include "engine/analysis/uv_overlap.h"
#include "engine/analysis/uv_stretch.h"
#include "engine/core/progress.h"

namespace mesher::analysis {

struct LookOptions {
  std::uint64_t samples = 300'000;  ///< per surface, spread evenly over the area
  Progress* progress = nullptr;
};

/// A measure that does not apply, and why, for users: "the second model has no vertex colors".
struct NotMeasured {
  std::string what;
  std::string why;
};

/// How much the look of a surface deviates from that of the original. Measures that do not apply
/// are missing.
struct LookDeviation {
  /// Angles between shading normals, in degrees.
  std::optional<TwoSidedSpread> normals;
  bool first_has_normals = false;   ///< those of the file; otherwise those of the faces count
  bool second_has_normals = false;  ///< likewise
  /// Distances between points with the same texture coordinates, in model units.
  std::optional<TwoSidedSpread> texture;
  double texture_covered =
      0.0;  ///< share of the samples of `texture`, of both directions the least
  std::optional<TwoSidedSpread> uv_slide;  ///< in texels
  std::optional<UvStretch> stretch;        ///< of the second surface
  std::optional<FlippedUvs> flipped;       ///< faces of the second surface
  std::optional<UvOverlap> overlap;
  struct Colors {
    TwoSidedSpread cie76;
    TwoSidedSpread ciede2000;
  };
  std::optional<Colors> colors;  ///< of vertices
  std::vector<NotMeasured> not_measured;
};

/// Measures the look of `b` against that of the original `a`, at samples of both surfaces. The same
/// for any number of threads. O(samples log F) expected, parallel. Throws Cancelled. Pre: both
/// meshes have faces.
LookDeviation look_deviation(const AttributedSurface& a, const AttributedSurface& b,
                             const LookOptions& options = {});

}  // namespace mesher::analysis
