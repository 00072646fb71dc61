#include "engine/simplify/quadric_policy.h"

#include <algorithm>

#include "engine/simplify/eight_edges.h"
#include "engine/simplify/plane_cost.h"

namespace mesher::simplify {
namespace {

/// Recomputes the cost without cancellation. Damping moves the optimum off a corner of flat parts,
/// so an end that is cheaper by more than `clearly` replaces it.
void evaluate_planes(const Surface& surface, Halfedge h, float clearly, Candidate& candidate) {
  const std::optional<PlaneCosts> costs = plane_costs(surface, h, candidate.position);
  if (!costs) return;
  candidate.error = costs->at_point;
  const auto offer = [&](Vertex end, float cost) {
    if (!(cost + clearly < candidate.error)) return;
    candidate.error = cost;
    candidate.position = surface.mesh().position(end);
  };
  offer(surface.mesh().origin(h), costs->at_origin);
  offer(surface.mesh().target(h), costs->at_target);
}

}  // namespace

Candidate QuadricPolicy::evaluate(const Surface& surface, Halfedge h,
                                  AllowedPlacement allowed) const {
  const EdgeQuadric<float> edge = surface.edge_quadric(h);
  const Placed placed = place(surface, h, edge, placement_, allowed);
  const float size = edge.scale();
  const float tie_break = kTieBreak * size;
  Candidate candidate{0.0F, std::max(edge.cost(placed.offset), 0.0F), placed.position};
  if (candidate.error < kQuadricDoubt * size) {
    const bool may_move = allowed == AllowedPlacement::anywhere && placement_ == Placement::optimal;
    evaluate_planes(surface, h, may_move ? kClearlyCheaper * tie_break : kNever, candidate);
  }
  candidate.cost = candidate.error + tie_break;
  return candidate;
}

void QuadricPolicy::evaluate_costs(const Surface& surface, std::span<const Halfedge> edges,
                                   CostPrecision precision, float* costs) const {
  if (placement_ != Placement::optimal) {
    return CollapsePolicy::evaluate_costs(surface, edges, precision, costs);
  }
  const auto one = [&](Halfedge h, AllowedPlacement allowed) {
    return evaluate(surface, h, allowed).cost;
  };
  if (precision == CostPrecision::guess) {
    const auto eight = [&](const EightHalfedges& halfedges) {
      const auto [from, to] = surface.ends(halfedges);
      return guessed_cost(from.quadric, to.quadric, to.position - from.position);
    };
    return evaluate_edges(surface, edges, eight, one, costs);
  }
  const auto eight = [&](const EightHalfedges& halfedges) {
    const EdgeQuadric<Float8> quadrics = surface.edge_quadrics(halfedges);
    return quadrics.ranked_cost(best_offset(quadrics));
  };
  evaluate_edges(surface, edges, eight, one, costs);
}

void QuadricPolicy::evaluate_around(const Surface& surface, Vertex v, const Fan& fan,
                                    CostPrecision precision, float* costs) const {
  if (placement_ != Placement::optimal || !fan.is_smooth()) {
    return CollapsePolicy::evaluate_around(surface, v, fan, precision, costs);
  }
  const auto eight = [&](const StateLanes<Float8>& from, const StateLanes<Float8>& to,
                         const EightHalfedges&, std::size_t first) {
    if (precision == CostPrecision::guess)
      return guessed_cost(from.quadric, to.quadric, to.position - from.position);
    const EdgeQuadric<Float8> edges = spoke_quadrics(fan, first, from, to);
    return edges.ranked_cost(best_offset(edges));
  };
  evaluate_spokes(surface, v, fan, eight, costs);
}

}  // namespace mesher::simplify
