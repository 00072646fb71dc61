#pragma once

#include <glm/vec3.hpp>
#include <optional>

#include "engine/simplify/surface.h"

namespace mesher::simplify {

/// Costs of merging an edge at three positions.
struct PlaneCosts {
  float at_point = 0.0F;
  float at_origin = 0.0F;
  float at_target = 0.0F;
};

/// Returns the cost of merging the edge of `h` at `p` and at its ends: the squared distances to the
/// planes of the faces at both ends, each times the area of its face, and to the planes across the
/// feature edges there. Equals the quadric's cost, but squares each distance after computing it, so
/// nothing cancels: 14 digits instead of the quadric's 7. Returns none at a vertex of more than 64
/// faces, because the work would become quadratic. O(valence).
std::optional<PlaneCosts> plane_costs(const Surface& surface, Halfedge h, const glm::vec3& p);

}  // namespace mesher::simplify
