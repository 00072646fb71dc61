#pragma once

#include <cstdint>
#include <vector>

#include "engine/mesh/build/edge_matching.h"

namespace mesher {

/// Returns the faces to flip so that neighbors agree in orientation. Each component (over edges of
/// exactly two faces) is walked once; of its two orientations, the one that flips fewer faces is
/// chosen. A one-sided surface still disagrees along some edges afterward. O(F). Throws
/// Cancelled. Internal to building.
std::vector<std::uint32_t> faces_to_flip(const Array<Vertex>& origin, const EdgeMatching& matching,
                                         Progress* progress);

/// Gives the matching of the faces as they are after corners 1 and 2 of each face in `flips` were
/// swapped, without matching them again. O(F). Pre: `origin` has the flipped faces; the matching is
/// that of the faces before, and lists no duplicate; `flips` has no face twice.
void flip_faces(EdgeMatching& matching, const Array<Vertex>& origin,
                const std::vector<std::uint32_t>& flips);

}  // namespace mesher
