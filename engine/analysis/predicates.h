#pragma once

#include <cmath>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace mesher::analysis {

/// Exact signs of determinants of points (J. Shewchuk, "Adaptive precision floating-point
/// arithmetic and fast robust geometric predicates", 1997).
///
/// A determinant is computed in double first, with an error bound. If the bound does not decide the
/// sign, it is computed again as an expansion: an unevaluated sum of doubles that holds every bit.
///
/// Pre, for all: each coordinate is the value of a finite float. Then every sign is right, over the
/// whole range of float, subnormal numbers included: all terms are multiples of 2^-447 and below
/// 2^392 in magnitude, so that nothing overflows and no rounding error underflows in double.

namespace detail {

int exact_orientation(const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& c);
int exact_orientation(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c,
                      const glm::dvec3& d);

inline constexpr double kHalfUlp = 0x1p-53;

inline int sign(double value) {
  return static_cast<int>(value > 0.0) - static_cast<int>(value < 0.0);
}

}  // namespace detail

/// Returns 1 if `a`, `b`, `c` turn counterclockwise, -1 if clockwise, 0 if they are collinear.
/// O(1).
inline int orientation(const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& c) {
  constexpr double kBound = (3.0 + 16.0 * detail::kHalfUlp) * detail::kHalfUlp;
  const double left = (a.x - c.x) * (b.y - c.y);
  const double right = (a.y - c.y) * (b.x - c.x);
  const double value = left - right;
  if (std::abs(value) > kBound * (std::abs(left) + std::abs(right))) return detail::sign(value);
  return detail::exact_orientation(a, b, c);
}

/// Returns 1 if `d` is on the side of the plane from which `a`, `b`, `c` appear counterclockwise,
/// -1 if it is on the other side, 0 if the four are coplanar. O(1).
inline int orientation(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c,
                       const glm::dvec3& d) {
  constexpr double kBound = (7.0 + 56.0 * detail::kHalfUlp) * detail::kHalfUlp;
  const glm::dvec3 u = b - a;
  const glm::dvec3 v = c - a;
  const glm::dvec3 w = d - a;
  const double yz = u.y * v.z;
  const double zy = u.z * v.y;
  const double zx = u.z * v.x;
  const double xz = u.x * v.z;
  const double xy = u.x * v.y;
  const double yx = u.y * v.x;
  const double value = w.x * (yz - zy) + w.y * (zx - xz) + w.z * (xy - yx);
  const double magnitude = std::abs(w.x) * (std::abs(yz) + std::abs(zy)) +
                           std::abs(w.y) * (std::abs(zx) + std::abs(xz)) +
                           std::abs(w.z) * (std::abs(xy) + std::abs(yx));
  if (std::abs(value) > kBound * magnitude) return detail::sign(value);
  return detail::exact_orientation(a, b, c, d);
}

}  // namespace mesher::analysis
