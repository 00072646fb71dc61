#pragma once

#include "engine/analysis/attributed_surface.h"
#include "engine/core/progress.h"

namespace mesher::analysis {

/// How much of the textures is used more than once, as shares of the texture area that faces of the
/// surface cover. Faces of different images never overlap.
struct UvOverlap {
  double original = 0.0;  ///< of the original surface, such as mirrored halves and copies
  double second = 0.0;    ///< of the second surface
  /// Of the second surface, where the original covers the texture less often: charts that have
  /// grown into each other.
  double added = 0.0;
  bool is_measured = false;  ///< false: the second surface covers no texture
};

/// Counts the faces at texels of an even grid. Textures repeat beyond 0 and 1. The grid has 1,024
/// texels a side, or fewer if the textures are covered many times. Faces that span more than
/// `kMostTiles` repetitions are left out. O(F + texels covered). Throws Cancelled.
UvOverlap uv_overlap(const AttributedSurface& original, const AttributedSurface& second,
                     Progress* progress = nullptr);

inline constexpr int kMostTiles = 16;

}  // namespace mesher::analysis
