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

/// Returns how far the faces of a wedge disagree about its values where its vertex moves: areas
/// times squared differences, as a quadric of the way.
Quadric<float> AttributeField::extension(std::uint32_t wedge) const {
  const float* const s = record(wedge);
  if (!(s[0] > 0.0F)) return {};
  Quadric<float> q{s[1], s[2], s[3], s[4], s[5], s[6], {}};
  for (std::size_t j = 0; j < size_; ++j) {
    const float* const g = s + row(j);
    const Vec3<float> w = Vec3<float>{g[0], g[1], g[2]} * (1.0F / s[0]);
    q.xx -= w.x * g[0];
    q.xy -= w.x * g[1];
    q.xz -= w.x * g[2];
    q.yy -= w.y * g[1];
    q.yz -= w.y * g[2];
    q.zz -= w.z * g[2];
  }
  return q;
}

AttributeQuadric<float> AttributeField::quadric_across(const Surface& surface, Halfedge h) const {
  const Mesh& mesh = surface.mesh();
  AttributeQuadric<float> sum = quadric(surface, h);
  const Pairs sides = pairs(mesh, h);
  const Vec3<float> half =
      (surface.state(mesh.target(h)).position - surface.state(mesh.origin(h)).position) * 0.5F;
  for (const bool is_at_target : {false, true}) {
    const Vec3<float> end = is_at_target ? half : half * -1.0F;  // seen from the midpoint
    const Aside beside = aside(mesh, is_at_target ? mesh.target(h) : mesh.origin(h), sides);
    for (const std::uint32_t wedge : beside.all()) {
      const Quadric<float> q = extension(wedge);
      const Vec3<float> at_end = q.times(end);
      sum.a = sum.a + q;
      sum.linear = sum.linear + at_end;
      sum.constant += dot(end, at_end);
    }
  }
  return sum;
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
    cost += std::max(dot(y, extension(wedge).times(y)), 0.0F);
  return cost;
}

}  // namespace mesher::simplify
