#include "engine/simplify/appraisal.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "engine/analysis/triangle_tree.h"

namespace mesher {
namespace {

// The squared length of the mean normal, by area, below which a vertex counts as pointed: 0.5 is
// that of a right-angled ridge, a third that of a cube's corner. Ridges count too: below 0.5 the
// worst point is a tenth worse.
constexpr float kPointed = 0.75F;

bool is_pointed(const Surface& surface, Vertex v) {
  const Quadric<float>& q = surface.state(v).quadric;
  return dot(q.g, q.g) < kPointed * q.trace() * q.trace();
}

/// The squared distance of an end of the edge to the faces that will be there.
double squared_distance_to_new(const Mesh& mesh, Vertex end, const Fan& fan,
                               const glm::dvec3& center) {
  const glm::dvec3 q(mesh.position(end));
  double least = glm::dot(q - center, q - center);
  for (std::size_t i = 0; i < fan.size(); ++i) {
    const glm::dvec3 a(mesh.position(fan.ring()[i]));
    const glm::dvec3 b(mesh.position(fan.ring()[i + 1]));
    least = std::min(least, squared_distance(q, {center, a, b}));
  }
  return least;
}

/// That of the new vertex to the faces that are there now.
double squared_distance_to_old(const Mesh& mesh, Halfedge h, const Fan& fan,
                               const glm::dvec3& center) {
  const auto to_face = [&](Halfedge side) {
    const auto corner = [&](Halfedge s) { return glm::dvec3(mesh.position(mesh.origin(s))); };
    return squared_distance(center,
                            {corner(side), corner(Mesh::next(side)), corner(Mesh::prev(side))});
  };
  double least = to_face(h);
  if (mesh.twin(h).is_valid()) least = std::min(least, to_face(mesh.twin(h)));
  for (const Halfedge spoke : fan.spokes())
    least = std::min(least, to_face(spoke));
  return least;
}

float distance_moved(const Mesh& mesh, Halfedge h, const Fan& fan, const glm::dvec3& center) {
  return static_cast<float>(
      std::sqrt(std::max({squared_distance_to_new(mesh, mesh.origin(h), fan, center),
                          squared_distance_to_new(mesh, mesh.target(h), fan, center),
                          squared_distance_to_old(mesh, h, fan, center)})));
}

}  // namespace

Appraisal appraise(const Surface& surface, Halfedge h, const Fan& fan, const Candidate& candidate) {
  const Mesh& mesh = surface.mesh();
  const Vertex from = mesh.origin(h);
  const Vertex to = mesh.target(h);
  Appraisal result{candidate.cost + fan.turned_area() * fan.turned_area(),
                   std::max(surface.state(from).retreat(), surface.state(to).retreat())};
  if (!is_pointed(surface, from) && !is_pointed(surface, to)) return result;
  result.retreat += distance_moved(mesh, h, fan, glm::dvec3(candidate.position));
  const float worth = result.retreat * result.retreat;
  result.cost += worth * worth;
  return result;
}

}  // namespace mesher
