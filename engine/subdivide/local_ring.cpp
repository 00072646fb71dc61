#include "engine/subdivide/local_ring.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "engine/core/assert.h"
#include "engine/mesh/circulators.h"
#include "engine/mesh/unit_vector.h"
#include "engine/subdivide/sharp_masks.h"
#include "engine/subdivide/sharpness.h"

namespace mesher::subdivide {
namespace {

// The slowest ring shrinks to 5/8 per step: after this many steps, less than 1e-13 of it remains.
constexpr int kStepsToConverge = 64;
// Enough for a ring of up to a dozen neighbors to lie in its tangent plane. More steps would hurt:
// at a dart, the ring shrinks faster in one direction than in the other and degenerates to a line.
constexpr int kStepsToFlatten = 24;

}  // namespace

void LocalRing::gather(const LevelView& level, const Features& features, const SharpVertex& vertex,
                       const SubdivideOptions& options) {
  options_ = options;
  vertex_ = level.position[vertex.v.index()];
  center_ = glm::dvec3(0.0);
  own_ = vertex.own;
  halfedges_.clear();
  spokes_.clear();
  Circulator at(level, level.outgoing[vertex.v.index()]);
  do {
    halfedges_.push_back(*at);
    spokes_.push_back({.end = level.position[level.origin[Mesh::next(*at).index()].index()]});
  } while (at.advance());
  const Halfedge incoming = Mesh::prev(halfedges_.back());
  if (!at.is_closed()) {
    spokes_.push_back({.end = level.position[level.origin[incoming.index()].index()]});
  }
  note_sharpness(level, features, vertex, incoming);
}

/// `incoming`: the half-edge along the last spoke of a boundary vertex, which has no outgoing
/// half-edge.
void LocalRing::note_sharpness(const LevelView& level, const Features& features,
                               const SharpVertex& vertex, Halfedge incoming) {
  sharp_edges_.clear();
  for (const std::uint32_t i : features.at(vertex)) {
    const Halfedge h = features.edges()[i].h;
    sharp_edges_.emplace_back(h, i);
    const Halfedge twin = level.twin[h.index()];
    if (twin.is_valid()) sharp_edges_.emplace_back(twin, i);
  }
  std::ranges::sort(sharp_edges_);
  for (std::size_t k = 0; k < spokes_.size(); ++k) {
    const Halfedge h = k < halfedges_.size() ? halfedges_[k] : incoming;
    const auto found = std::ranges::lower_bound(sharp_edges_, h, {}, &SharpHalfedge::first);
    if (found == sharp_edges_.end() || found->first != h) continue;
    const SharpEdge& edge = features.edges()[found->second];
    const std::size_t side = features.side(edge, vertex);
    spokes_[k].sharpness = edge.sharpness;
    spokes_[k].near_left = edge.left[side];
    spokes_[k].far_left = edge.left[1 - side];
    spokes_[k].end_kind = features.other_end(edge, vertex).kind;
  }
}

VertexKind LocalRing::kind() const {
  std::size_t first = spokes_.size();
  std::size_t last = 0;
  std::size_t count = 0;
  for (std::size_t i = 0; i < spokes_.size(); ++i) {
    if (spokes_[i].sharpness <= 0.0F) continue;
    if (count++ == 0) first = i;
    last = i;
  }
  switch (vertex_rule(own_, count)) {
    case VertexRule::corner:
      return VertexKind::corner;
    case VertexRule::smooth:
      return count == 1 ? VertexKind::dart : VertexKind::smooth;
    case VertexRule::crease:
      break;
  }
  if (options_.creases == CreaseRules::derose98) return VertexKind::crease;
  const bool is_regular =
      is_boundary() ? spokes_.size() == 4 : spokes_.size() == 6 && last - first == 3;
  return is_regular ? VertexKind::regular_crease : VertexKind::crease;
}

bool LocalRing::has_semi_sharp() const {
  if (is_semi_sharp(own_)) return true;
  for (const Spoke& spoke : spokes_) {
    if (is_semi_sharp(spoke.sharpness)) return true;
  }
  return false;
}

void LocalRing::settle() {
  // Hoppe's masks depend on the kinds of the neighbors. After one step, the neighbors are new edge
  // vertices, of known kind.
  if (options_.creases == CreaseRules::hoppe94) step();
  while (has_semi_sharp())
    step();
  // DeRose's masks at a dart have no closed-form limit here.
  if (kind() == VertexKind::dart && options_.creases == CreaseRules::derose98) converge();
}

void LocalRing::converge() {
  const std::vector<Spoke> spokes = spokes_;
  const glm::dvec3 vertex = vertex_;
  for (int i = 0; i < kStepsToConverge; ++i)
    step();
  center_ = vertex_;
  // Repeat with the vertex at the origin: the ring then keeps its precision while it shrinks.
  spokes_ = spokes;
  vertex_ = vertex;
  for (int i = 0; i < kStepsToFlatten; ++i) {
    center_on_vertex();
    step();
  }
}

/// Translates the ring so that the vertex is at the origin.
void LocalRing::center_on_vertex() {
  for (Spoke& spoke : spokes_)
    spoke.end -= vertex_;
  vertex_ = glm::dvec3(0.0);
}

void LocalRing::step() {
  const VertexKind own_kind = kind();
  next_spokes_ = spokes_;
  for (std::size_t i = 0; i < spokes_.size(); ++i)
    next_spokes_[i].end = next_end(i, own_kind);
  vertex_ = next_vertex();
  std::swap(spokes_, next_spokes_);
  own_ = decayed(own_);
  decay_spoke_sharpness();
}

glm::dvec3 LocalRing::next_vertex() const {
  std::vector<SharpSpoke> sharp;
  glm::dvec3 sum(0.0);
  for (const Spoke& spoke : spokes_) {
    sum += spoke.end;
    if (spoke.sharpness > 0.0F) sharp.push_back({spoke.end, spoke.sharpness, spoke.near_left});
  }
  glm::dvec3 smooth = vertex_;
  if (!is_boundary()) {
    const RingMask mask = loop_vertex_mask(static_cast<std::uint32_t>(spokes_.size()));
    smooth = mask.own * vertex_ + mask.each * sum;
  }
  return sharp_vertex_point(vertex_, own_, sharp, smooth);
}

glm::dvec3 LocalRing::next_end(std::size_t i, VertexKind own_kind) const {
  const Spoke& spoke = spokes_[i];
  // On a boundary, the first and last spokes are sharp and use no smooth mask.
  const glm::dvec3 smooth =
      kLoopEdgeEnd * (vertex_ + spoke.end) + kLoopEdgeOpposite * (before(i).end + after(i).end);
  if (spoke.sharpness <= 0.0F) return smooth;
  return sharp_edge_point(options_.creases,
                          {.end = {vertex_, spoke.end},
                           .kind = {own_kind, spoke.end_kind},
                           .sharpness = spoke.sharpness,
                           .left = {spoke.near_left, spoke.far_left}},
                          smooth);
}

void LocalRing::decay_spoke_sharpness() {
  for (Spoke& spoke : spokes_) {
    // The edge now ends at a new vertex; its other half continues from there.
    spoke.sharpness = spoke.near_left;
    spoke.end_kind = spoke.far_left > 0.0F ? VertexKind::regular_crease : VertexKind::dart;
  }
  SemiSharpSum at_vertex;
  for (const Spoke& spoke : spokes_)
    at_vertex.add(spoke.sharpness);
  const bool is_chaikin = options_.decay == CreaseDecay::chaikin;
  for (Spoke& spoke : spokes_) {
    SemiSharpSum at_end;  // at the new vertex: this half and the other one
    at_end.add(spoke.sharpness);
    at_end.add(spoke.far_left);
    spoke.near_left =
        is_chaikin ? chaikin_decayed(spoke.sharpness, at_vertex) : decayed(spoke.sharpness);
    spoke.far_left =
        is_chaikin ? chaikin_decayed(spoke.sharpness, at_end) : decayed(spoke.sharpness);
  }
}

glm::dvec3 LocalRing::limit_position() const {
  const VertexKind own_kind = kind();
  if (own_kind == VertexKind::corner) return vertex_;
  glm::dvec3 sum(0.0);
  glm::dvec3 crease(0.0);
  for (const Spoke& spoke : spokes_) {
    sum += spoke.end;
    if (spoke.sharpness > 0.0F) crease += spoke.end;
  }
  if (own_kind == VertexKind::crease || own_kind == VertexKind::regular_crease) {
    const RingMask mask = crease_limit_mask(options_.creases, own_kind);
    return mask.own * vertex_ + mask.each * crease;
  }
  if (own_kind == VertexKind::dart && options_.creases == CreaseRules::derose98) return center_;
  const RingMask mask = loop_limit_mask(static_cast<std::uint32_t>(spokes_.size()));
  return mask.own * vertex_ + mask.each * sum;
}

std::span<const glm::dvec3> LocalRing::limit_normals() {
  const std::size_t faces = halfedges_.size();
  const VertexKind own_kind = kind();
  if (own_kind == VertexKind::smooth || own_kind == VertexKind::dart) {
    normals_.assign(faces, smooth_normal());
    return normals_;
  }
  normals_.assign(faces, glm::dvec3(0.0));
  sharp_.clear();
  for (std::size_t i = 0; i < spokes_.size(); ++i) {
    if (spokes_[i].sharpness > 0.0F) sharp_.push_back(i);
  }
  if (sharp_.empty()) sharp_.push_back(0);  // sharp itself: a cone, cut open anywhere
  const std::size_t sectors = is_boundary() ? sharp_.size() - 1 : sharp_.size();
  for (std::size_t k = 0; k < sectors; ++k) {
    const std::size_t first = sharp_[k];
    const std::size_t next = k + 1 < sharp_.size() ? sharp_[k + 1] : sharp_[0] + faces;
    const glm::dvec3 normal = sector_normal(own_kind, first, next - first + 1);
    for (std::size_t i = first; i < next; ++i)
      normals_[i % faces] = normal;
  }
  return normals_;
}

glm::dvec3 LocalRing::smooth_normal() const {
  const double step = 2.0 * std::numbers::pi / static_cast<double>(spokes_.size());
  glm::dvec3 along(0.0);
  glm::dvec3 across(0.0);
  for (std::size_t i = 0; i < spokes_.size(); ++i) {
    const double angle = step * static_cast<double>(i);
    along += std::cos(angle) * spokes_[i].end;
    across += std::sin(angle) * spokes_[i].end;
  }
  return unit_or_zero(glm::cross(along, across));
}

/// Returns the normal between two sharp spokes: `count` spokes from `first` on, including both.
glm::dvec3 LocalRing::sector_normal(VertexKind own_kind, std::size_t first,
                                    std::size_t count) const {
  const auto end = [&](std::size_t i) { return spokes_[(first + i) % spokes_.size()].end; };
  const glm::dvec3 average = fan_normal(first, count);
  if (own_kind == VertexKind::corner) {
    // The plane of the two creases' tangents, unless they are nearly parallel.
    const glm::dvec3 a = unit_or_zero(end(0) - vertex_);
    const glm::dvec3 b = unit_or_zero(end(count - 1) - vertex_);
    const glm::dvec3 normal = glm::cross(a, b);
    constexpr double kNearlyParallel = 1e-4;
    if (glm::length(normal) < kNearlyParallel) return average;
    return unit_or_zero(glm::dot(normal, average) < 0.0 ? -normal : normal);
  }
  std::vector<double> weights(count);
  glm::dvec3 across = across_crease_tangent(options_.creases, own_kind, weights) * vertex_;
  for (std::size_t i = 0; i < count; ++i)
    across += weights[i] * end(i);
  const glm::dvec3 normal = unit_or_zero(glm::cross(end(0) - end(count - 1), across));
  return normal == glm::dvec3(0.0) ? average : normal;
}

glm::dvec3 LocalRing::fan_normal(std::size_t first, std::size_t count) const {
  glm::dvec3 sum(0.0);
  for (std::size_t i = 0; i + 1 < count; ++i) {
    sum += glm::cross(spokes_[(first + i) % spokes_.size()].end - vertex_,
                      spokes_[(first + i + 1) % spokes_.size()].end - vertex_);
  }
  return unit_or_zero(sum);
}

}  // namespace mesher::subdivide
