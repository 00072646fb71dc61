#include "engine/simplify/cost_policy.h"

namespace mesher::simplify {

void CollapsePolicy::evaluate_costs(const Surface& surface, std::span<const Halfedge> edges,
                                    CostPrecision, float* costs) const {
  for (const Halfedge h : edges) {
    const AllowedPlacement allowed = surface.allowed_placement(h);
    *costs++ = allowed == AllowedPlacement::nowhere ? kNever : evaluate(surface, h, allowed).cost;
  }
}

void CollapsePolicy::evaluate_around(const Surface& surface, Vertex, const Fan& fan,
                                     CostPrecision precision, float* costs) const {
  evaluate_costs(surface, fan.spokes(), precision, costs);
  if (fan.is_closed() || fan.size() == 0) return;
  const Halfedge last = Mesh::prev(fan.spokes().back());
  evaluate_costs(surface, {&last, 1}, precision, costs + fan.size());
}

bool CollapsePolicy::allows(const Surface&, Halfedge, const Fan&, const glm::vec3&) const {
  return true;
}

void CollapsePolicy::will_need_later(Halfedge) const {}

void CollapsePolicy::will_need(const Mesh&, Halfedge) const {}

void CollapsePolicy::will_need(const Fan&) const {}

void CollapsePolicy::collapsing(const Surface&, Halfedge, const Fan&, const glm::vec3&) {}

Placed place(const Surface& surface, Halfedge h, const EdgeQuadric<float>& edge,
             Placement placement, AllowedPlacement allowed) {
  const Mesh& mesh = surface.mesh();
  const bool is_at_end = allowed != AllowedPlacement::anywhere || placement == Placement::endpoint;
  if (is_at_end) {
    const bool is_at_target = allowed == AllowedPlacement::anywhere
                                  ? is_target_better(edge)
                                  : allowed == AllowedPlacement::at_target;
    return is_at_target ? Placed{edge.half, mesh.position(mesh.target(h))}
                        : Placed{edge.half * -1.0F, mesh.position(mesh.origin(h))};
  }
  const Vec3<float> y = placement == Placement::optimal ? best_offset(edge) : Vec3<float>{};
  const Vec3<float> p = surface.midpoint(h) + y;
  return {y, {p.x, p.y, p.z}};
}

}  // namespace mesher::simplify
