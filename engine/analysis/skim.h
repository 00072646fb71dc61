#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "engine/analysis/triangle_reach.h"
#include "engine/core/progress.h"
#include "engine/mesh/mesh.h"

namespace mesher::analysis {

/// The result of a first, cheap pass over the faces of a surface.
struct Skimmed {
  /// A part of a face that may be farther away than allowed.
  struct Unclear {
    Face face;
    double upper = std::numeric_limits<double>::infinity();  ///< upper bound; infinite: unknown
    std::optional<Triangle> part;                            ///< no value: the whole face
  };

  double upper = 0.0;            ///< upper bound for all other points
  std::vector<Unclear> unclear;  ///< by face, ascending
};

/// The surfaces and what is known of their distance.
struct SkimInput {
  const Mesh& from;
  const Mesh& to;
  std::span<const Face> hints;                ///< per face, a face of `to` that is probably near
  std::optional<std::span<const Face>> only;  ///< if set, only these faces count; ascending
  std::span<const std::uint8_t> is_near;      ///< per vertex: 1 if within `near`, 0 if unknown
  double near = 0.0;
  double rounding = 0.0;  ///< added to computed distances; not to 0, which means equal faces
};

/// Returns bounds for the distance of each face of a surface from another surface, without a search
/// tree. It uses the distances of the corners if they are known, then the distance of the face's
/// middle from its hint, then OverlayWalk. A face that this does not settle is split; only its
/// parts that are not settled either remain. The nearer the hints, the fewer remain. O(F) if the
/// surfaces are near each other; parallel, the same for any number of threads. Throws Cancelled.
Skimmed skim(const SkimInput& input, double allowed, Progress* progress);

}  // namespace mesher::analysis
