#pragma once

#include <glm/vec3.hpp>
#include <optional>

#include "engine/simplify/surface.h"

namespace mesher {

/// What merging the edge of `h` at `p` costs: the squared distances of `p` to the planes of the
/// faces at both ends, each times the area of its face, and to the planes across the feature edges
/// there. The same as the quadric's cost, but each distance is found before it is squared, so that
/// nothing cancels: 14 digits where the quadric has 7. None at a hub of more than 64 faces, so that
/// a hub does not make the work quadratic. O(valence).
std::optional<float> plane_cost(const Surface& surface, Halfedge h, const glm::vec3& p);

}  // namespace mesher
