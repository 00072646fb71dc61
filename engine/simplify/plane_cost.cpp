#include "engine/simplify/plane_cost.h"

#include <glm/geometric.hpp>

#include "engine/mesh/circulators.h"

namespace mesher {
namespace {

float star_cost(const Surface& surface, Vertex v, const glm::vec3& p) {
  const Mesh& mesh = surface.mesh();
  const glm::vec3 moved = p - mesh.position(v);
  float sum = 0.0F;
  for (const Halfedge h : halfedges_around(mesh, v)) {
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

float plane_cost(const Surface& surface, Halfedge h, const glm::vec3& p) {
  const Mesh& mesh = surface.mesh();
  return star_cost(surface, mesh.origin(h), p) + star_cost(surface, mesh.target(h), p);
}

}  // namespace mesher
