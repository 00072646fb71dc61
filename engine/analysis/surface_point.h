#pragma once

#include <array>
#include <glm/vec3.hpp>

#include "engine/mesh/mesh.h"

namespace mesher::analysis {

/// A point of a surface: a face, and the barycentric weights of its corners.
struct SurfacePoint {
  Face face;
  glm::vec3 weights{1.0F, 0.0F, 0.0F};  ///< not negative; their sum is 1 up to rounding
};

/// Returns the barycentric weights of the point of a triangle that is nearest to `p`. A triangle
/// without area counts as its sides. Computed in double. O(1). (C. Ericson, "Real-Time Collision
/// Detection", 2005, 5.1.5)
glm::dvec3 nearest_weights(const glm::dvec3& p, const std::array<glm::dvec3, 3>& triangle);

/// Returns the corners of a face.
std::array<glm::dvec3, 3> corners_of(const Mesh& mesh, Face f);

/// Returns the position of a point.
glm::dvec3 position_of(const Mesh& mesh, const SurfacePoint& point);

}  // namespace mesher::analysis
