#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

namespace mesher::analysis {

using Triangle = std::array<glm::dvec3, 3>;
/// The squared lengths of the sides; side i starts at corner i.
using Sides = std::array<double, 3>;

inline Sides squared_sides(const Triangle& t) {
  Sides sides;
  for (std::size_t c = 0; c < 3; ++c) {
    const glm::dvec3 side = t[(c + 1) % 3] - t[c];
    sides[c] = glm::dot(side, side);
  }
  return sides;
}

/// Returns an upper bound for the distance from a point of a triangle to the nearest corner. With
/// an obtuse or right angle, it is half the longest side. Otherwise the circumradius bounds it: the
/// longest side over twice the sine of its opposite angle, which is at least 60 degrees.
inline double reach(const Sides& sides) {
  const double longest = std::max({sides[0], sides[1], sides[2]});
  const bool is_obtuse = 2.0 * longest >= sides[0] + sides[1] + sides[2];
  return std::sqrt(longest * (is_obtuse ? 0.25 : 1.0 / 3.0));
}

}  // namespace mesher::analysis
