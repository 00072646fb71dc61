#include "engine/simplify/quadric_policy.h"

#include <algorithm>
#include <array>

#include "engine/simplify/plane_cost.h"

namespace mesher::simplify {
namespace {

template <class F>
StateLanes<F> broadcast_state(const VertexState& s) {
  const auto all = [](float x) { return broadcast<F>(x); };
  const Quadric<float>& q = s.quadric;
  return {{all(q.xx),
           all(q.xy),
           all(q.xz),
           all(q.yy),
           all(q.yz),
           all(q.zz),
           {all(q.g.x), all(q.g.y), all(q.g.z)}},
          {all(s.position.x), all(s.position.y), all(s.position.z)}};
}

/// Collects edges and evaluates them in batches of eight.
class EightEdges {
 public:
  EightEdges(const Surface& surface, CostPrecision precision, float* costs)
      : surface_(surface), precision_(precision), costs_(costs) {}

  void add(Halfedge h, std::size_t index) {
    edges_[count_] = h;
    indices_[count_] = index;
    if (++count_ == 8) flush();
  }

  void flush() {
    if (count_ == 0) return;
    std::fill(edges_.begin() + static_cast<std::ptrdiff_t>(count_), edges_.end(), edges_[0]);
    const Float8 found = evaluate();
    std::array<float, 8> all{};
    store4(all.data(), found.low);
    store4(all.data() + 4, found.high);
    for (std::size_t lane = 0; lane < count_; ++lane)
      costs_[indices_[lane]] = all[lane];
    count_ = 0;
  }

 private:
  Float8 evaluate() const {
    if (precision_ == CostPrecision::guess) {
      const auto [from, to] = surface_.ends(edges_);
      return guessed_cost(from.quadric, to.quadric, to.position - from.position);
    }
    const EdgeQuadric<Float8> quadrics = surface_.edge_quadrics(edges_);
    return quadrics.ranked_cost(best_offset(quadrics));
  }

  const Surface& surface_;
  CostPrecision precision_;
  float* costs_;
  std::array<Halfedge, 8> edges_{};
  std::array<std::size_t, 8> indices_{};
  std::size_t count_ = 0;
};

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
  EightEdges eight(surface, precision, costs);
  for (std::size_t i = 0; i < edges.size(); ++i) {
    const AllowedPlacement allowed =
        surface.is_constrained() ? surface.allowed_placement(edges[i]) : AllowedPlacement::anywhere;
    if (allowed == AllowedPlacement::anywhere && !surface.is_feature(edges[i])) {
      eight.add(edges[i], i);
    } else {
      costs[i] =
          allowed == AllowedPlacement::nowhere ? kNever : evaluate(surface, edges[i], allowed).cost;
    }
  }
  eight.flush();
}

void QuadricPolicy::evaluate_around(const Surface& surface, Vertex v, const Fan& fan,
                                    CostPrecision precision, float* costs) const {
  if (placement_ != Placement::optimal || !fan.is_smooth()) {
    return CollapsePolicy::evaluate_around(surface, v, fan, precision, costs);
  }
  const StateLanes<Float8> from = broadcast_state<Float8>(surface.state(v));
  for (std::size_t i = 0; i < fan.size(); i += 8) {
    std::array<Vertex, 8> neighbors;
    for (std::size_t lane = 0; lane < 8; ++lane)
      neighbors[lane] = fan.ring()[std::min(i + lane, fan.size())];
    const StateLanes<Float8> to = surface.states(neighbors);
    const Vec3<Float8> edge = to.position - from.position;
    Float8 found;
    if (precision == CostPrecision::guess) {
      found = guessed_cost(from.quadric, to.quadric, edge);
    } else {
      const Vec3<Float8> shared = fan.area_vectors_before(i) + fan.area_vectors(i);
      const EdgeQuadric<Float8> edges(from.quadric, to.quadric, shared, edge);
      found = edges.ranked_cost(best_offset(edges));
    }
    store4(costs + i, found.low);
    store4(costs + i + 4, found.high);
  }
}

}  // namespace mesher::simplify
