#pragma once

#include <cstdint>

#include "engine/core/progress.h"
#include "engine/mesh/mesh.h"

namespace mesher::analysis {

/// The distance from one surface to another, in model units. Mean and RMS are weighted by area; the
/// maximum is over the samples and the vertices.
struct OneSidedDistance {
  double rms = 0.0;
  double mean = 0.0;
  double max = 0.0;
};

/// The distance between two surfaces in both directions. Each two-sided figure is the larger of the
/// two (P. Cignoni, C. Rocchini, R. Scopigno, "Metro: measuring error on simplified surfaces",
/// 1998).
struct SurfaceDistance {
  OneSidedDistance forward;   ///< from points of the first surface to the second
  OneSidedDistance backward;  ///< from points of the second to the first
  double diagonal = 0.0;      ///< of the first mesh's box: the base of percentages

  OneSidedDistance two_sided() const;
  /// Returns `distance` in percent of the diagonal; 0 if the first mesh is a point.
  double percent(double distance) const {
    return diagonal > 0.0 ? 100.0 * distance / diagonal : 0.0;
  }
};

struct DistanceOptions {
  std::uint64_t samples = 300'000;  ///< per side, spread evenly over the area
  Progress* progress = nullptr;
};

/// Returns the sampled distance between two surfaces. Each surface is sampled evenly by area and at
/// its vertices, and the exact distance from each sample to the other's triangles is measured. The
/// sample positions are fixed: the same meshes give the same figures, on any number of threads. A
/// sampled maximum is a lower bound. O((samples + V) log F) expected, parallel. Throws Cancelled.
/// Pre: both meshes have faces.
SurfaceDistance surface_distance(const Mesh& a, const Mesh& b, const DistanceOptions& options = {});

}  // namespace mesher::analysis
