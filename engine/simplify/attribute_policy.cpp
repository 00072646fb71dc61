#include "engine/simplify/attribute_policy.h"

#include <algorithm>

#include "engine/simplify/eight_edges.h"
#include "engine/simplify/plane_cost.h"

namespace mesher::simplify {
namespace {

/// A position of the merged vertex, and what it costs.
struct Choice {
  glm::vec3 position;
  float surface;
  float attributes;
  float total() const { return surface + attributes; }
};

class Choices {
 public:
  Choices(const Surface& surface, const AttributeField& field, Halfedge h, bool is_across)
      : surface_(surface),
        field_(field),
        h_(h),
        is_across_(is_across),
        edge_(surface.edge_quadric(h)) {}

  Choice at_target() const {
    return {surface_.mesh().position(surface_.mesh().target(h_)), surface_cost(edge_.half),
            is_across_ ? field_.cost_at_end_across(surface_, h_, true)
                       : field_.cost_at_target(surface_, h_)};
  }
  Choice at_origin() const {
    return {surface_.mesh().position(surface_.mesh().origin(h_)), surface_cost(edge_.half * -1.0F),
            is_across_ ? field_.cost_at_end_across(surface_, h_, false)
                       : field_.cost_at_origin(surface_, h_)};
  }
  Choice at_end() const {
    const Choice origin = at_origin();
    const Choice target = at_target();
    return target.total() <= origin.total() ? target : origin;
  }
  Choice at_midpoint() const { return at({0.0F, 0.0F, 0.0F}, field_.quadric(surface_, h_)); }
  Choice best() const {
    const AttributeQuadric<float> attributes =
        is_across_ ? field_.quadric_across(surface_, h_) : field_.quadric(surface_, h_);
    EdgeQuadric<float> sum = edge_;
    sum.both = sum.both + attributes.a;
    sum.linear = sum.linear + attributes.linear;
    return at(best_offset(sum, edge_.both.trace()), attributes);
  }

  float tie_break() const { return kTieBreak * edge_.scale(); }
  /// Computes the cost of the surface without cancellation if it is small. If the vertex may move,
  /// an end that is clearly cheaper replaces the position.
  Choice refined(Choice choice, bool may_move) const {
    if (choice.surface >= kQuadricDoubt * edge_.scale()) return choice;
    const std::optional<PlaneCosts> costs = plane_costs(surface_, h_, choice.position);
    if (!costs) return choice;
    choice.surface = costs->at_point;
    if (!may_move) return choice;
    Choice origin = at_origin();
    Choice target = at_target();
    origin.surface = costs->at_origin;
    target.surface = costs->at_target;
    for (const Choice& end : {origin, target}) {
      if (end.total() + kClearlyCheaper * tie_break() < choice.total()) choice = end;
    }
    return choice;
  }

 private:
  float surface_cost(const Vec3<float>& y) const { return std::max(edge_.cost(y), 0.0F); }
  Choice at(const Vec3<float>& y, const AttributeQuadric<float>& attributes) const {
    const Vec3<float> p = surface_.midpoint(h_) + y;
    return {{p.x, p.y, p.z}, surface_cost(y), attributes.cost(y)};
  }

  const Surface& surface_;
  const AttributeField& field_;
  Halfedge h_;
  bool is_across_;
  EdgeQuadric<float> edge_;
};

Choice choose(const Choices& choices, AllowedPlacement allowed, Placement placement) {
  if (allowed == AllowedPlacement::at_origin) return choices.at_origin();
  if (allowed == AllowedPlacement::at_target) return choices.at_target();
  switch (placement) {
    case Placement::endpoint:
      return choices.at_end();
    case Placement::midpoint:
      return choices.at_midpoint();
    case Placement::optimal:
      break;
  }
  return choices.best();
}

/// Returns where two rules both allow a vertex.
AllowedPlacement both(AllowedPlacement a, AllowedPlacement b) {
  if (a == AllowedPlacement::anywhere) return b;
  return b == AllowedPlacement::anywhere || a == b ? a : AllowedPlacement::nowhere;
}

}  // namespace

Candidate AttributePolicy::evaluate(const Surface& surface, Halfedge h,
                                    AllowedPlacement allowed) const {
  const bool is_across = allowed == AllowedPlacement::across;
  if (is_across) allowed = both(surface.ends_across(h), field_.ends_across(surface.mesh(), h));
  if (allowed == AllowedPlacement::nowhere) return {};
  const Choices choices(surface, field_, h, is_across);
  // Across a seam that is not free, the exact values at an end are worth more than the best place.
  const bool keeps_end = is_across && !surface.seams_are_free();
  const Placement placement = keeps_end ? Placement::endpoint : this->placement();
  const bool may_move = allowed == AllowedPlacement::anywhere && placement == Placement::optimal;
  const Choice choice = choices.refined(choose(choices, allowed, placement), may_move);
  return {choice.total() + choices.tie_break(), choice.surface, choice.position};
}

/// Returns the costs of eight edges that may be merged anywhere.
Float8 AttributePolicy::costs(const EdgeQuadric<Float8>& edges,
                              const std::array<Halfedge, 8>& halfedges) const {
  const AttributeQuadric<Float8> attributes = field_.quadrics(halfedges, edges.half);
  EdgeQuadric<Float8> sum = edges;
  sum.both = sum.both + attributes.a;
  sum.linear = sum.linear + attributes.linear;
  const Vec3<Float8> y = best_offset(sum, edges.both.trace());
  return edges.ranked_cost(y) + attributes.cost(y);
}

/// Same, quickly: as guessed_cost, half the cost of merging at the midpoint.
Float8 AttributePolicy::guessed_costs(const StateLanes<Float8>& from, const StateLanes<Float8>& to,
                                      const std::array<Halfedge, 8>& halfedges) const {
  const Vec3<Float8> edge = to.position - from.position;
  const Float8 half = broadcast<Float8>(0.5F);
  return guessed_cost(from.quadric, to.quadric, edge) +
         field_.midpoint_costs(halfedges, edge * half) * half;
}

void AttributePolicy::evaluate_costs(const Surface& surface, std::span<const Halfedge> edges,
                                     CostPrecision precision, float* costs) const {
  if (placement() != Placement::optimal)
    return QuadricPolicy::evaluate_costs(surface, edges, precision, costs);
  const auto eight = [&](const EightHalfedges& halfedges) {
    if (precision == CostPrecision::exact)
      return this->costs(surface.edge_quadrics(halfedges), halfedges);
    const auto [from, to] = surface.ends(halfedges);
    return guessed_costs(from, to, halfedges);
  };
  const auto one = [&](Halfedge h, AllowedPlacement allowed) {
    return evaluate(surface, h, allowed).cost;
  };
  evaluate_edges(surface, edges, eight, one, costs);
}

void AttributePolicy::evaluate_around(const Surface& surface, Vertex v, const Fan& fan,
                                      CostPrecision precision, float* costs) const {
  if (placement() != Placement::optimal || !fan.is_smooth())
    return QuadricPolicy::evaluate_around(surface, v, fan, precision, costs);
  const auto eight = [&](const StateLanes<Float8>& from, const StateLanes<Float8>& to,
                         const EightHalfedges& halfedges, std::size_t first) {
    return precision == CostPrecision::guess
               ? guessed_costs(from, to, halfedges)
               : this->costs(spoke_quadrics(fan, first, from, to), halfedges);
  };
  evaluate_spokes(surface, v, fan, eight, costs);
}

}  // namespace mesher::simplify
