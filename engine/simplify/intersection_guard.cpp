#include "engine/simplify/intersection_guard.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>
#include <utility>

#include "engine/mesh/circulators.h"

namespace mesher::simplify {
namespace {

analysis::ExactTriangle triangle(const Mesh& mesh, Face f) {
  return {mesh.position(mesh.origin(Mesh::halfedge(f, 0))),
          mesh.position(mesh.origin(Mesh::halfedge(f, 1))),
          mesh.position(mesh.origin(Mesh::halfedge(f, 2)))};
}

/// Returns whether the changed pair intersects and did not before. Pre: `changed` is not
/// degenerate.
bool is_new_pair(const analysis::ExactTriangle& changed, const analysis::ExactTriangle& other,
                 const analysis::ExactTriangle& before,
                 const analysis::ExactTriangle& other_before) {
  if (!analysis::do_intersect(changed, other)) return false;
  return analysis::is_degenerate(before) || analysis::is_degenerate(other_before) ||
         !analysis::do_intersect(before, other_before);
}

/// Returns the faces whose corners all belong to the region, in the order of their vertices.
std::vector<Face> faces_of(const Surface& surface, std::uint32_t region,
                           std::span<const Vertex> vertices) {
  const Mesh& mesh = surface.mesh();
  std::vector<Face> faces;
  faces.reserve(2 * vertices.size());
  for (const Vertex v : vertices) {
    for (const Halfedge h : halfedges_around(mesh, v)) {
      const Vertex a = mesh.target(h);
      const Vertex b = mesh.origin(Mesh::prev(h));
      // Add each face once, at its lowest corner.
      if (v < a && v < b && surface.state(a).region == region &&
          surface.state(b).region == region) {
        faces.push_back(Mesh::face(h));
      }
    }
  }
  return faces;
}

}  // namespace

IntersectionGuard::IntersectionGuard(const Surface& surface, GuardedSpace& space,
                                     std::uint32_t region, std::span<const Vertex> vertices)
    : space_(space), region_(region), tree_(space.slot_of) {
  tree_.build(surface, faces_of(surface, region, vertices));
}

/// Computes the triangles and boxes of the new faces, with the vertex at `p`.
void IntersectionGuard::place_faces(const Surface& surface, const Fan& fan, const glm::vec3& p) {
  const Mesh& mesh = surface.mesh();
  triangles_.resize(fan.size());
  boxes_.resize(fan.size());
  all_ = {p, p};
  const glm::dvec3 center(p);
  for (std::size_t i = 0; i < fan.size(); ++i) {
    const glm::vec3& a = mesh.position(fan.ring()[i]);
    const glm::vec3& b = mesh.position(fan.ring()[i + 1]);
    triangles_[i] = {center, a, b};
    const Box box{glm::min(glm::min(a, b), p), glm::max(glm::max(a, b), p)};
    boxes_[i] = LaneBox(box);
    all_.min = glm::min(all_.min, box.min);
    all_.max = glm::max(all_.max, box.max);
  }
}

/// Projects the new faces along their mean normal, with the vertex at the origin, and finds out
/// whether they form a graph over that plane: all face the front and they go around the vertex at
/// most once. If they do, they cannot intersect one another. The margin is far above rounding
/// errors, so this test need not be exact.
void IntersectionGuard::flatten(const Fan& fan) {
  constexpr double kMargin = 1e-6;
  glm::dvec3 sum(0.0);
  for (const analysis::ExactTriangle& t : triangles_)
    sum += glm::cross(t[1] - t[0], t[2] - t[0]);
  const double length = std::sqrt(glm::dot(sum, sum));
  const glm::dvec3 mean = sum / length;
  const bool is_x_across = std::abs(mean.x) < std::abs(mean.y);
  axes_[0] = glm::cross(is_x_across ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0), mean);
  axes_[1] = glm::cross(mean, axes_[0]);
  const double least =
      kMargin * length * glm::dot(axes_[0], axes_[0]) / static_cast<double>(triangles_.size());
  for (std::vector<float>* numbers :
       {&sides_[0].x, &sides_[1].x, &sides_[2].x, &sides_[0].y, &sides_[1].y, &sides_[2].y,
        &sides_[0].shift, &sides_[1].shift, &sides_[2].shift}) {
    if (numbers->size() < triangles_.size() + 4) numbers->resize(2 * triangles_.size() + 4);
  }
  reach_ = 0.0F;
  is_graph_ = false;
  std::size_t rounds = 0;
  glm::dvec2 a = flattened(triangles_[0][1]);
  for (std::size_t i = 0; i < triangles_.size(); ++i) {
    const glm::dvec2 b = flattened(triangles_[i][2]);
    const double turn = a.x * b.y - a.y * b.x;
    if (!(turn > least)) return;
    // Counts crossings from below to above: one per revolution.
    rounds += static_cast<std::size_t>(a.y < 0.0 && b.y >= 0.0);
    sides_[0].set(i, b - a, turn);
    sides_[1].set(i, -b, 0.0);
    sides_[2].set(i, a, 0.0);
    reach_ = std::max(reach_, static_cast<float>(std::abs(b.x) + std::abs(b.y)));
    reach_ = std::max(reach_, static_cast<float>(std::abs(a.x) + std::abs(a.y)));
    a = b;
  }
  is_graph_ = rounds <= (fan.is_closed() ? 1U : 0U);
}

glm::dvec2 IntersectionGuard::flattened(const glm::dvec3& p) const {
  const glm::dvec3 q = p - triangles_[0][0];
  return {glm::dot(q, axes_[0]), glm::dot(q, axes_[1])};
}

/// Returns which of new faces i to i + 3 are certainly separated from a triangle by one of their
/// sides, in the projection along the mean normal. The plane through that side along the normal
/// then separates the two in space, and they meet at most in shared corners on that side. Lanes
/// past the last face are unspecified.
Int4 IntersectionGuard::find_apart(const Fan& fan, std::size_t i, const FlatTriangle& other) const {
  // Rounding in float is a hundredth of this.
  constexpr float kMargin = 1e-5F;
  Int4 begins;
  Int4 ends;
  std::memcpy(&begins, &fan.ring()[i], sizeof(begins));
  const std::size_t last = std::min(i + 4, fan.size());
  for (std::size_t lane = 0; lane < 4; ++lane)
    ends[lane] = static_cast<std::int32_t>(fan.ring()[std::min(i + lane + 1, last)].index());
  const Float4 zero{};
  const Float4 away = zero - std::numeric_limits<float>::infinity();
  std::array<Float4, 3> nearest{away, away, away};
  float reach = reach_;
  for (std::size_t c = 0; c < 3; ++c)
    reach = std::max(reach, std::abs(other.x[c]) + std::abs(other.y[c]));
  for (std::size_t c = 0; c < 3; ++c) {
    const Int4 id = Int4{} + static_cast<std::int32_t>(other.corner[c].index());
    const Int4 is_begin = begins == id;
    const Int4 is_end = ends == id;
    const std::array<Int4, 3> is_shared{is_begin | is_end, is_end, is_begin};
    for (std::size_t side = 0; side < 3; ++side) {
      const Float4 inside = sides_[side].distances(i, other.x[c], other.y[c]);
      nearest[side] = greater_of(nearest[side], select(is_shared[side], away, inside));
    }
  }
  Int4 is_apart{};
  for (std::size_t side = 0; side < 3; ++side)
    is_apart |= nearest[side] < sides_[side].lengths(i) * (zero - kMargin * reach);
  return is_apart;
}

IntersectionGuard::Verdict IntersectionGuard::check(const Surface& surface, const Fan& fan,
                                                    Vertex removed, Vertex kept,
                                                    const glm::vec3& p) {
  place_faces(surface, fan, p);
  if (fan.size() == 0) return Verdict::legal;
  if (space_.has_regions && !space_.territory.owns(region_, all_)) {
    return Verdict::outside_territory;
  }
  flatten(fan);
  if (!is_graph_ && has_new_pair(surface, fan)) return Verdict::intersects;
  const Mesh& mesh = surface.mesh();
  const bool is_met = tree_.any_of(LaneBox(all_), [&](Face f, const LaneBox& box) {
    const Halfedge h = Mesh::halfedge(f);
    const std::array<Vertex, 3> v{mesh.origin(h), mesh.origin(Mesh::next(h)),
                                  mesh.origin(Mesh::prev(h))};
    if (!v[0].is_valid()) return false;
    for (const Vertex corner : v) {
      if (corner == removed || corner == kept) return false;
    }
    return has_new_pair(surface, fan, f, box);
  });
  return is_met ? Verdict::intersects : Verdict::legal;
}

/// Returns whether two faces of the fan would intersect that do not yet.
bool IntersectionGuard::has_new_pair(const Surface& surface, const Fan& fan) const {
  const Mesh& mesh = surface.mesh();
  for (std::size_t i = 0; i < fan.size(); ++i) {
    for (std::size_t k = i + 1; k < fan.size(); ++k) {
      if (!do_overlap(boxes_[i], boxes_[k])) continue;
      if (is_new_pair(triangles_[i], triangles_[k], triangle(mesh, Mesh::face(fan.spokes()[i])),
                      triangle(mesh, Mesh::face(fan.spokes()[k])))) {
        return true;
      }
    }
  }
  return false;
}

/// Returns whether a face of the fan would intersect `other`, and does not yet.
bool IntersectionGuard::has_new_pair(const Surface& surface, const Fan& fan, Face other,
                                     const LaneBox& box) const {
  const Mesh& mesh = surface.mesh();
  FlatTriangle flat;
  analysis::ExactTriangle t;
  for (std::uint32_t c = 0; c < 3; ++c) {
    flat.corner[c] = mesh.origin(Mesh::halfedge(other, c));
    t[c] = mesh.position(flat.corner[c]);
    const glm::dvec2 q = flattened(t[c]);
    flat.x[c] = static_cast<float>(q.x);
    flat.y[c] = static_cast<float>(q.y);
  }
  for (std::size_t i = 0; i < fan.size(); i += 4) {
    const Int4 is_apart = is_graph_ ? find_apart(fan, i, flat) : Int4{};
    for (std::size_t lane = 0; lane < 4 && i + lane < fan.size(); ++lane) {
      const std::size_t k = i + lane;
      if (is_apart[lane] != 0 || !do_overlap(boxes_[k], box)) continue;
      if (analysis::is_degenerate(t)) return false;
      const analysis::ExactTriangle before = triangle(mesh, Mesh::face(fan.spokes()[k]));
      if (is_new_pair(triangles_[k], t, before, t)) return true;
    }
  }
  return false;
}

void IntersectionGuard::collapsed(const Surface& surface, const Fan& fan) {
  for (std::size_t i = 0; i < fan.size(); ++i)
    tree_.move(Mesh::face(fan.spokes()[i]), boxes_[i]);
  removed_ += 2;
  if (2 * removed_ < tree_.faces().size()) return;
  std::vector<Face> left;
  left.reserve(tree_.faces().size() / 2 + 1);
  for (const Face f : tree_.faces()) {
    if (!surface.is_removed(f)) left.push_back(f);
  }
  tree_.build(surface, std::move(left));
  removed_ = 0;
}

}  // namespace mesher::simplify
