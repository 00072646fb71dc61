#pragma once

#include <array>
#include <glm/vec3.hpp>
#include <span>

#include "engine/subdivide/masks.h"

namespace mesher::subdivide {

// The positions of sharp edges and vertices after a step, including semi-sharp blends. Pure
// functions of points and sharpnesses; in double, because there are few.

/// A sharp edge, seen from the vertex at one end.
struct SharpSpoke {
  glm::dvec3 end;       ///< the vertex at the other end
  float before = 0.0F;  ///< sharpness of the edge
  float after = 0.0F;   ///< sharpness of this half on the next level
};

/// A sharp edge, seen from the new vertex on it.
struct SharpSpan {
  std::array<glm::dvec3, 2> end;
  std::array<VertexKind, 2> kind{};  ///< of the ends
  float sharpness = 0.0F;
  std::array<float, 2> left{};  ///< sharpness of its halves on the next level
};

/// Returns the next position of a vertex. `own`: its own sharpness; `smooth`: its next position if
/// nothing were sharp. O(spokes).
glm::dvec3 sharp_vertex_point(const glm::dvec3& vertex, float own,
                              std::span<const SharpSpoke> spokes, const glm::dvec3& smooth);

/// Returns the position of the new vertex on a sharp edge; `smooth` as above. O(1).
glm::dvec3 sharp_edge_point(CreaseRules rules, const SharpSpan& edge, const glm::dvec3& smooth);

}  // namespace mesher::subdivide
