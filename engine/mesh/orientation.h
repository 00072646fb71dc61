#pragma once

#include <cstdint>
#include <vector>

#include "engine/mesh/edge_matching.h"

namespace mesher {

/// Which faces to turn around so that neighbours agree. Internal to building. Each component (over
/// edges of exactly two faces) is walked once; where two ways remain, the one that turns fewer
/// faces is taken. A one-sided surface still disagrees along some edges afterwards. O(F).
std::vector<std::uint32_t> faces_to_flip(const Array<Vertex>& origin, const EdgeMatching& matching);

}  // namespace mesher
