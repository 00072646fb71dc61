#include "engine/subdivide/sharp_masks.h"

#include "engine/subdivide/sharpness.h"

namespace mesher::subdivide {
namespace {

/// The sum and number of the neighbors along edges that are sharp at one level.
struct CreaseSum {
  glm::dvec3 sum{0.0};
  std::size_t count = 0;
  void add(const glm::dvec3& p) {
    sum += p;
    ++count;
  }
};

glm::dvec3 ruled(VertexRule rule, const glm::dvec3& vertex, const CreaseSum& crease,
                 const glm::dvec3& smooth) {
  switch (rule) {
    case VertexRule::corner:
      return vertex;
    case VertexRule::crease:
      return kCreaseVertexMask.own * vertex + kCreaseVertexMask.each * crease.sum;
    case VertexRule::smooth:
      break;
  }
  return smooth;
}

}  // namespace

glm::dvec3 sharp_vertex_point(const glm::dvec3& vertex, float own,
                              std::span<const SharpSpoke> spokes, const glm::dvec3& smooth) {
  CreaseSum before;
  CreaseSum after;
  Transition transition;
  for (const SharpSpoke& spoke : spokes) {
    before.add(spoke.end);
    if (spoke.after > 0.0F) after.add(spoke.end);
    transition.add(spoke.before, spoke.after);
  }
  transition.add(own, decayed(own));
  const VertexRule rule = vertex_rule(own, before.count);
  const VertexRule next_rule = vertex_rule(decayed(own), after.count);
  const glm::dvec3 sharper = ruled(rule, vertex, before, smooth);
  if (rule == next_rule) return sharper;
  const double weight = transition.weight();
  return weight * sharper + (1.0 - weight) * ruled(next_rule, vertex, after, smooth);
}

glm::dvec3 sharp_edge_point(CreaseRules rules, const SharpSpan& edge, const glm::dvec3& smooth) {
  if (!has_sharp_mask(rules, edge.kind[0], edge.kind[1])) return smooth;
  const double weight = sharp_edge_weight(rules, edge.kind[0], edge.kind[1]);
  const glm::dvec3 sharp = weight * edge.end[0] + (1.0 - weight) * edge.end[1];
  const double blend = edge_blend(edge.sharpness, edge.left[0], edge.left[1]);
  if (blend >= 1.0) return sharp;
  return blend * sharp + (1.0 - blend) * smooth;
}

}  // namespace mesher::subdivide
