#pragma once

#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "engine/core/progress.h"
#include "engine/mesh/mesh.h"

namespace mesher {

/// What a first, cheap look at the faces of a surface has found out.
struct Skimmed {
  /// A face that may be farther than allowed.
  struct Unclear {
    Face face;
    double upper = std::numeric_limits<double>::infinity();  ///< bound; infinite: none is known
  };

  double upper = 0.0;            ///< bound for all faces but the unclear ones
  std::vector<Unclear> unclear;  ///< ascending
};

/// What is known of the surfaces.
struct SkimInput {
  const Mesh& from;
  const Mesh& to;
  std::span<const Face> hints;            ///< for each face one of `to` that is likely to be near
  std::span<const std::uint8_t> is_near;  ///< for each vertex: not farther than `near`; or 0
  double near = 0.0;
  double rounding = 0.0;  ///< is added to computed distances other than 0 of the same faces
};

/// Bounds the distance of each face of a surface from another one, without a search tree: by the
/// distances of its corners, where they are known, by that of its middle from a face that is likely
/// to be near, else by OverlayWalk. The nearer the hints, the fewer faces remain unclear. O(F)
/// where the surfaces are near each other; parallel, the same for any number of threads. Throws
/// Cancelled.
Skimmed skim(const SkimInput& input, double allowed, Progress* progress);

}  // namespace mesher
