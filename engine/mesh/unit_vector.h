#pragma once

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

namespace mesher {

/// Returns the length-1 vector in the direction of `v`, or zero if it has none or is not finite. In
/// double, because squared lengths of a model 1e-6 units across fall below the range of floats.
/// O(1).
inline glm::dvec3 unit_or_zero(const glm::dvec3& v) {
  const double length = glm::length(v);
  return length > 0.0 && std::isfinite(length) ? v / length : glm::dvec3(0.0);
}

}  // namespace mesher
