#pragma once

#include <cstdint>

#include "engine/core/progress.h"
#include "engine/mesh/mesh.h"

namespace mesher {

/// How far one surface lies from another, in model units. Mean and RMS are by area; the maximum is
/// over the samples and the vertices.
struct OneSidedDistance {
  double rms = 0.0;
  double mean = 0.0;
  double max = 0.0;
};

/// The distance between two surfaces, both ways; each two-sided figure is the larger of the two
/// (P. Cignoni, C. Rocchini, R. Scopigno, "Metro: measuring error on simplified surfaces", 1998).
struct SurfaceDistance {
  OneSidedDistance forward;   ///< from points of the first surface to the second
  OneSidedDistance backward;  ///< from points of the second to the first
  double diagonal = 0.0;      ///< of the first mesh's box: what percentages refer to

  OneSidedDistance two_sided() const;
  /// `distance` in percent of the diagonal; 0 where the first mesh is a point.
  double percent(double distance) const {
    return diagonal > 0.0 ? 100.0 * distance / diagonal : 0.0;
  }
};

struct DistanceOptions {
  std::uint64_t samples = 300'000;  ///< a side, spread evenly over the area
  Progress* progress = nullptr;
};

/// Samples each surface evenly by area (at fixed places: the same meshes give the same figures, on
/// any number of threads) and at its vertices, and measures the exact distance to the other's
/// triangles. O((samples + V) log F) expected, parallel. A sampled maximum is a lower bound.
/// Pre: both meshes have faces. Throws Cancelled.
SurfaceDistance surface_distance(const Mesh& a, const Mesh& b, const DistanceOptions& options = {});

}  // namespace mesher
