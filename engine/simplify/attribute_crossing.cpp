// The part of AttributeField that merges edges across seams.
#include <algorithm>

#include "engine/mesh/circulators.h"
#include "engine/simplify/attribute_field.h"

namespace mesher::simplify {

AttributeField::Aside AttributeField::aside(const Mesh& mesh, Vertex v, const Pairs& pairs) const {
  Aside result;
  for (const Halfedge h : halfedges_around(mesh, v)) {
    const std::uint32_t wedge = wedge_[h.index()];
    const bool is_at_edge = std::ranges::any_of(pairs.all(), [&](const Pair& pair) {
      return pair.origin == wedge || pair.target == wedge;
    });
    if (is_at_edge || std::ranges::find(result.all(), wedge) != result.all().end()) continue;
    if (result.count == kMostAside) {
      result.is_complete = false;
      break;
    }
    result.wedge[result.count++] = wedge;
  }
  return result;
}

AllowedPlacement AttributeField::ends_across(const Mesh& mesh, Halfedge h) const {
  const Pairs sides = pairs(mesh, h);
  for (const Vertex v : {mesh.origin(h), mesh.target(h)}) {
    if (!aside(mesh, v, sides).is_complete) return AllowedPlacement::nowhere;
  }
  if (sides.count == 1) return AllowedPlacement::anywhere;
  const auto& [left, right] = sides.pair;
  if (left.origin == right.origin) return AllowedPlacement::at_origin;
  return left.target == right.target ? AllowedPlacement::at_target : AllowedPlacement::anywhere;
}

/// Returns how far the faces of a wedge disagree about its values where its vertex moves by `y`:
/// areas times squared differences.
float AttributeField::extension_cost(std::uint32_t wedge, const Vec3<float>& y) const {
  const float* const s = record(wedge);
  if (!(s[0] > 0.0F)) return 0.0F;
  const Quadric<float> q{s[1], s[2], s[3], s[4], s[5], s[6], {}};
  const Float4 along{y.x, y.y, y.z, 0.0F};
  float cost = dot(y, q.times(y));
  for (std::size_t j = 0; j < size_; ++j) {
    const float change = sum_of(load4(s + row(j)) * along);
    cost -= change * change / s[0];
  }
  return std::max(cost, 0.0F);
}

float AttributeField::cost_at_end_across(const Surface& surface, Halfedge h,
                                         bool is_at_target) const {
  const Mesh& mesh = surface.mesh();
  const Vec3<float> edge =
      surface.state(mesh.target(h)).position - surface.state(mesh.origin(h)).position;
  const Vec3<float> y = is_at_target ? edge : edge * -1.0F;
  const Vertex moving = is_at_target ? mesh.origin(h) : mesh.target(h);
  float cost = cost_at_end(surface, h, is_at_target);
  const Aside beside = aside(mesh, moving, pairs(mesh, h));
  for (const std::uint32_t wedge : beside.all())
    cost += extension_cost(wedge, y);
  return cost;
}

}  // namespace mesher::simplify
