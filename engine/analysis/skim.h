#pragma once

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

/// Bounds the distance of each face of a surface from another one, without a search tree: by the
/// distance of its middle from a face that is likely to be near, else by OverlayWalk. `hints`: for
/// each face one of the other surface; the nearer, the fewer faces remain unclear. `rounding`: what
/// is added to computed distances other than 0 of faces that are the same. O(F) where the surfaces
/// are near each other; parallel, the same for any number of threads. Throws Cancelled.
Skimmed skim(const Mesh& from, const Mesh& to, std::span<const Face> hints, double allowed,
             double rounding, Progress* progress);

}  // namespace mesher
