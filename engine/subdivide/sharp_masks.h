#pragma once

#include <array>
#include <glm/vec3.hpp>
#include <span>

#include "engine/subdivide/masks.h"

namespace mesher {

// Where a step puts what is sharp, semi-sharp blends included. Pure functions of points and
// sharpnesses; in double precision, as there are few.

/// A sharp edge as the vertex at one end sees it.
struct SharpSpoke {
  glm::dvec3 end;       ///< the vertex at the other end
  float before = 0.0F;  ///< its sharpness
  float after = 0.0F;   ///< what is left on this half of it
};

/// A sharp edge as the new vertex on it sees it.
struct SharpSpan {
  std::array<glm::dvec3, 2> end;
  std::array<VertexKind, 2> kind{};  ///< of the ends
  float sharpness = 0.0F;
  std::array<float, 2> left{};  ///< what is left on its halves
};

/// Where a vertex goes. `own`: its own sharpness; `smooth`: where it would go if nothing were
/// sharp. O(spokes).
glm::dvec3 sharp_vertex_point(const glm::dvec3& vertex, float own,
                              std::span<const SharpSpoke> spokes, const glm::dvec3& smooth);

/// Where the new vertex on a sharp edge goes; `smooth` as above. O(1).
glm::dvec3 sharp_edge_point(CreaseRules rules, const SharpSpan& edge, const glm::dvec3& smooth);

}  // namespace mesher
