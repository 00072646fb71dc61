#include "engine/analysis/surface_point.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <limits>

namespace mesher::analysis {
namespace {

/// Returns the weights of the nearest point of the side from corner `from` to corner `to`.
glm::dvec3 weights_on_side(const glm::dvec3& p, const std::array<glm::dvec3, 3>& t, int from,
                           int to) {
  const glm::dvec3 side = t[to] - t[from];
  const double length = glm::dot(side, side);
  const double part =
      length > 0.0 ? std::clamp(glm::dot(p - t[from], side) / length, 0.0, 1.0) : 0.0;
  glm::dvec3 weights(0.0);
  weights[from] = 1.0 - part;
  weights[to] = part;
  return weights;
}

glm::dvec3 weights_on_sides(const glm::dvec3& p, const std::array<glm::dvec3, 3>& t) {
  glm::dvec3 best(1.0, 0.0, 0.0);
  double least = std::numeric_limits<double>::infinity();
  for (int side = 0; side < 3; ++side) {
    const glm::dvec3 weights = weights_on_side(p, t, side, (side + 1) % 3);
    const glm::dvec3 off = p - (weights[0] * t[0] + weights[1] * t[1] + weights[2] * t[2]);
    if (glm::dot(off, off) >= least) continue;
    least = glm::dot(off, off);
    best = weights;
  }
  return best;
}

}  // namespace

glm::dvec3 nearest_weights(const glm::dvec3& p, const std::array<glm::dvec3, 3>& t) {
  constexpr double kThin = 1e-12;  // as in squared_distance
  const glm::dvec3 ab = t[1] - t[0];
  const glm::dvec3 ac = t[2] - t[0];
  const glm::dvec3 normal = glm::cross(ab, ac);
  const double area = glm::dot(normal, normal);
  if (!(area > kThin * glm::dot(ab, ab) * glm::dot(ac, ac))) return weights_on_sides(p, t);
  const glm::dvec3 ap = p - t[0];
  const double b = glm::dot(glm::cross(ap, ac), normal) / area;
  const double c = glm::dot(glm::cross(ab, ap), normal) / area;
  if (b >= 0.0 && c >= 0.0 && b + c <= 1.0) return {1.0 - b - c, b, c};
  return weights_on_sides(p, t);
}

std::array<glm::dvec3, 3> corners_of(const Mesh& mesh, Face f) {
  std::array<glm::dvec3, 3> corners;
  for (std::uint32_t c = 0; c < 3; ++c)
    corners[c] = mesh.position(mesh.origin(Mesh::halfedge(f, c)));
  return corners;
}

glm::dvec3 position_of(const Mesh& mesh, const SurfacePoint& point) {
  const std::array<glm::dvec3, 3> t = corners_of(mesh, point.face);
  return double{point.weights[0]} * t[0] + double{point.weights[1]} * t[1] +
         double{point.weights[2]} * t[2];
}

}  // namespace mesher::analysis
