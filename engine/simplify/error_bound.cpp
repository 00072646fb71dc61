#include "engine/simplify/error_bound.h"

#include <algorithm>
#include <array>
#include <numeric>
#include <utility>

namespace mesher {

ErrorBound::ErrorBound(const Mesh& input, double bound)
    : tree_(input),
      squared_bound_(bound * bound),
      input_(input.positions().begin(), input.positions().end()),
      next_(input.vertex_count()) {
  std::iota(next_.begin(), next_.end(), 0U);
}

bool ErrorBound::is_near_input(const glm::dvec3& p) const {
  return tree_.nearest(p).squared_distance <= squared_bound_;
}

bool ErrorBound::allows(const Surface& surface, Vertex removed, Vertex kept, const Fan& fan,
                        const glm::vec3& p) const {
  const Mesh& mesh = surface.mesh();
  const glm::dvec3 center(p);
  if (!is_near_input(center)) return false;
  if (!reaches_all(mesh, removed, fan, center) || !reaches_all(mesh, kept, fan, center)) {
    return false;
  }
  for (std::size_t i = 0; i < fan.size(); ++i) {
    const glm::dvec3 a(mesh.position(fan.ring()[i]));
    const glm::dvec3 b(mesh.position(fan.ring()[i + 1]));
    if (!is_near_input(0.5 * (center + a)) || !is_near_input((center + a + b) / 3.0)) return false;
  }
  // An open fan ends with one edge more than it has faces: at the boundary, where it may cut across
  // a hole.
  if (fan.is_closed() || fan.size() == 0) return true;
  return is_near_input(0.5 * (center + glm::dvec3(mesh.position(fan.ring().back()))));
}

/// Whether the new faces pass near every input vertex for which `v` answers.
bool ErrorBound::reaches_all(const Mesh& mesh, Vertex v, const Fan& fan,
                             const glm::dvec3& center) const {
  const auto is_reached = [&](const glm::dvec3& q) {
    for (std::size_t i = 0; i < fan.size(); ++i) {
      const std::array<glm::dvec3, 3> face{center, mesh.position(fan.ring()[i]),
                                           mesh.position(fan.ring()[i + 1])};
      if (squared_distance(q, face) <= squared_bound_) return true;
    }
    return false;
  };
  std::uint32_t i = v.index();
  do {
    if (!is_reached(input_[i])) return false;
    i = next_[i];
  } while (i != v.index());
  return true;
}

void ErrorBound::collapsed(Vertex removed, Vertex kept) {
  // Two rings become one.
  std::swap(next_[removed.index()], next_[kept.index()]);
}

}  // namespace mesher
