#pragma once

#include "engine/analysis/spread.h"
#include "engine/analysis/surface_matches.h"
#include "engine/analysis/uv_tree.h"

namespace mesher::analysis {

/// Distances between points with the same texture coordinates, in model units, and the share of the
/// samples whose texture coordinates the other surface has.
struct TextureDeviation {
  Spread distances;
  double covered = 0.0;  ///< 0 to 1
};

/// Returns the texture deviation from one surface to another: the distance from each sample of
/// `from` to the point of `to` with the same texture coordinates (J. Cohen, M. Olano, D. Manocha,
/// "Appearance-preserving simplification", 1998). Where charts overlap it is the nearest such
/// point. Samples whose texture coordinates `to` lacks are left out: near the outlines of charts,
/// which simplification moves. `samples` are those of the matches. O(samples log F) expected,
/// parallel; the same for any number of threads.
TextureDeviation texture_deviation(const AttributedSurface& from, const UvTree& to,
                                   const SurfaceMatches& samples);

}  // namespace mesher::analysis
