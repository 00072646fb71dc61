#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

namespace mesher {

using Triangle = std::array<glm::dvec3, 3>;
/// Squared lengths, each from the corner of the same number.
using Sides = std::array<double, 3>;

inline Sides squared_sides(const Triangle& t) {
  Sides sides;
  for (std::size_t c = 0; c < 3; ++c) {
    const glm::dvec3 side = t[(c + 1) % 3] - t[c];
    sides[c] = glm::dot(side, side);
  }
  return sides;
}

/// How far a point of a triangle may be from the nearest corner. With an obtuse or right angle the
/// longest side's ends reach half of it each way; otherwise it is the circumradius, whose largest
/// angle has a sine of at least that of 60 degrees.
inline double reach(const Sides& sides) {
  const double longest = std::max({sides[0], sides[1], sides[2]});
  const bool is_obtuse = 2.0 * longest >= sides[0] + sides[1] + sides[2];
  return std::sqrt(longest * (is_obtuse ? 0.25 : 1.0 / 3.0));
}

}  // namespace mesher
