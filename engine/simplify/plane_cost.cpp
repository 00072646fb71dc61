#include "engine/simplify/plane_cost.h"

#include <glm/geometric.hpp>

#include "engine/mesh/circulators.h"

namespace mesher {
namespace {

constexpr int kMostFaces = 64;

std::optional<float> star_cost(const Surface& surface, Vertex v, const glm::vec3& p) {
  const Mesh& mesh = surface.mesh();
  const glm::vec3 moved = p - mesh.position(v);
  float sum = 0.0F;
  int faces = 0;
  for (const Halfedge h : halfedges_around(mesh, v)) {
    if (++faces > kMostFaces) return std::nullopt;
    const FaceShape& face = surface.shape(Mesh::face(h));
    const float distance = glm::dot(face.normal, moved);
    sum += face.area * distance * distance;
    for (const Halfedge side : {h, Mesh::prev(h)}) {
      if (!surface.is_feature(side)) continue;
      const float off_course = glm::dot(surface.across(side), moved);
      sum += off_course * off_course;
    }
  }
  return sum;
}

}  // namespace

std::optional<float> plane_cost(const Surface& surface, Halfedge h, const glm::vec3& p) {
  const Mesh& mesh = surface.mesh();
  const std::optional<float> at_origin = star_cost(surface, mesh.origin(h), p);
  if (!at_origin) return std::nullopt;
  const std::optional<float> at_target = star_cost(surface, mesh.target(h), p);
  return at_target ? std::optional(*at_origin + *at_target) : std::nullopt;
}

}  // namespace mesher
