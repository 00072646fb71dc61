#include "engine/simplify/plane_cost.h"

#include <glm/geometric.hpp>

#include "engine/mesh/circulators.h"

namespace mesher::simplify {
namespace {

constexpr int kMostPlanes = 64;

/// Costs of two positions with respect to the planes at one end.
struct StarCost {
  float at_point = 0.0F;
  float at_other_end = 0.0F;
};

std::optional<StarCost> star_cost(const Surface& surface, Vertex v, Vertex other,
                                  const glm::vec3& p) {
  const Mesh& mesh = surface.mesh();
  const glm::vec3 to_point = p - mesh.position(v);
  const glm::vec3 to_other = mesh.position(other) - mesh.position(v);
  const bool has_features = surface.constraint(v) != VertexConstraint::free;
  StarCost sum;
  const auto add = [&](const glm::vec3& normal, float weight) {
    const float point = glm::dot(normal, to_point);
    const float other_end = glm::dot(normal, to_other);
    sum.at_point += weight * point * point;
    sum.at_other_end += weight * other_end * other_end;
  };
  int faces = 0;
  for (const Halfedge h : halfedges_around(mesh, v)) {
    if (++faces > kMostPlanes) return std::nullopt;
    const FaceShape& face = surface.shape(Mesh::face(h));
    add(face.normal, face.area);
    if (!has_features) continue;
    for (const Halfedge side : {h, Mesh::prev(h)}) {
      if (surface.is_feature(side)) add(surface.across(side), surface.feature_weight(side));
    }
  }
  return sum;
}

}  // namespace

std::optional<PlaneCosts> plane_costs(const Surface& surface, Halfedge h, const glm::vec3& p) {
  const Vertex origin = surface.mesh().origin(h);
  const Vertex target = surface.mesh().target(h);
  const std::optional<StarCost> of_origin = star_cost(surface, origin, target, p);
  if (!of_origin) return std::nullopt;
  const std::optional<StarCost> of_target = star_cost(surface, target, origin, p);
  if (!of_target) return std::nullopt;
  // All planes at an end pass through it.
  return PlaneCosts{of_origin->at_point + of_target->at_point, of_target->at_other_end,
                    of_origin->at_other_end};
}

}  // namespace mesher::simplify
