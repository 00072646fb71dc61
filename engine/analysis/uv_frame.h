#pragma once

#include <array>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>

namespace mesher::analysis {

/// Returns twice the signed area of a triangle of the texture; 0 if it is so thin that the sign is
/// that of rounding. Positive: counterclockwise.
inline double uv_orientation(const std::array<glm::dvec2, 3>& uv) {
  constexpr double kThin = 1e-6;
  const glm::dvec2 ab = uv[1] - uv[0];
  const glm::dvec2 ac = uv[2] - uv[0];
  const glm::dvec2 bc = uv[2] - uv[1];
  const double area = ab.x * ac.y - ab.y * ac.x;
  const double longest = glm::max(glm::dot(ab, ab), glm::max(glm::dot(ac, ac), glm::dot(bc, bc)));
  return glm::abs(area) > kThin * longest ? area : 0.0;
}

/// The metric of a triangle in its texture coordinates: squared lengths of the changes of position
/// per unit of u and of v, and their product.
struct UvMetric {
  double uu = 0.0;
  double uv = 0.0;
  double vv = 0.0;

  double determinant() const { return uu * vv - uv * uv; }
};

/// Returns the metric of a triangle; none if its texture coordinates have no area.
inline std::optional<UvMetric> uv_metric(const std::array<glm::dvec3, 3>& position,
                                         const std::array<glm::dvec2, 3>& uv) {
  const double area = uv_orientation(uv);
  if (area == 0.0) return std::nullopt;
  const glm::dvec2 ab = uv[1] - uv[0];
  const glm::dvec2 ac = uv[2] - uv[0];
  const glm::dvec3 p = position[1] - position[0];
  const glm::dvec3 q = position[2] - position[0];
  const glm::dvec3 per_u = (ac.y * p - ab.y * q) / area;
  const glm::dvec3 per_v = (ab.x * q - ac.x * p) / area;
  return UvMetric{glm::dot(per_u, per_u), glm::dot(per_u, per_v), glm::dot(per_v, per_v)};
}

}  // namespace mesher::analysis
