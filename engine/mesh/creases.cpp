#include "engine/mesh/creases.h"

#include <cmath>
#include <glm/geometric.hpp>

namespace mesher {
namespace {

glm::dvec3 area_normal(const Mesh& mesh, Face f) {
  const glm::dvec3 a = mesh.position(mesh.origin(Mesh::halfedge(f, 0)));
  const glm::dvec3 b = mesh.position(mesh.origin(Mesh::halfedge(f, 1)));
  const glm::dvec3 c = mesh.position(mesh.origin(Mesh::halfedge(f, 2)));
  return glm::cross(b - a, c - a);
}

}  // namespace

float dihedral_angle_rad(const Mesh& mesh, Edge e) {
  if (mesh.is_boundary(e)) return 0.0F;
  const Halfedge h = Mesh::halfedge(e);
  const glm::dvec3 a = area_normal(mesh, Mesh::face(h));
  const glm::dvec3 b = area_normal(mesh, Mesh::face(mesh.twin(h)));
  return static_cast<float>(std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b)));
}

std::uint32_t tag_creases_by_angle(Mesh& mesh, float angle_rad) {
  std::uint32_t count = 0;
  for (std::uint32_t i = 0; i < mesh.halfedge_count(); ++i) {
    const Edge e = mesh.edge(Halfedge(i));
    if (e.index() != i || mesh.is_boundary(e)) continue;
    if (dihedral_angle_rad(mesh, e) <= angle_rad) continue;
    mesh.set_sharpness(e, kInfinitelySharp);
    ++count;
  }
  return count;
}

}  // namespace mesher
