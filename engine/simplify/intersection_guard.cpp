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

// Least distance from a plane, in relation to the sizes, that counts as certain. Rounding in float
// is a hundredth of this.
constexpr float kSideMargin = 1e-5F;
// Covers products that underflow.
constexpr float kLeastDoubt = 1e-30F;
// A triangle whose area is a smaller fraction of the product of two sides has no certain plane.
constexpr double kSliver = 1e-6;

double taxicab_length(const glm::dvec3& v) {
  return std::abs(v.x) + std::abs(v.y) + std::abs(v.z);
}

/// Returns whether the changed pair intersects and did not before. Pre: `changed` is not
/// degenerate.
bool is_new_pair(const analysis::ExactTriangle& changed, const analysis::ExactTriangle& other,
                 const analysis::ExactTriangle& before,
                 const analysis::ExactTriangle& other_before) {
  return analysis::do_intersect(changed, other) &&
         !analysis::do_areas_intersect(before, other_before);
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
  reach_ = 0.0F;
  ring_.resize(fan.size() + 5);
  normals_.resize(fan.size() + 4);
  const glm::dvec3 center(p);
  for (std::size_t i = 0; i < fan.size(); ++i) {
    const glm::vec3& a = mesh.position(fan.ring()[i]);
    const glm::vec3& b = mesh.position(fan.ring()[i + 1]);
    triangles_[i] = {center, a, b};
    const glm::dvec3 to_a = triangles_[i][1] - center;
    const glm::dvec3 to_b = triangles_[i][2] - center;
    ring_.set(i, to_a);
    ring_.set(i + 1, to_b);
    normals_.set(i, glm::cross(to_a, to_b));
    for (const glm::dvec3& v : {to_a, to_b})
      reach_ = std::max(reach_, static_cast<float>(taxicab_length(v)));
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
  flat_reach_ = 0.0F;
  is_graph_ = false;
  std::size_t rounds = 0;
  glm::dvec2 a = flattened(triangles_[0][1] - triangles_[0][0]);
  for (std::size_t i = 0; i < triangles_.size(); ++i) {
    const glm::dvec2 b = flattened(triangles_[i][2] - triangles_[i][0]);
    const double turn = a.x * b.y - a.y * b.x;
    if (!(turn > least)) return;
    // Counts crossings from below to above: one per revolution.
    rounds += static_cast<std::size_t>(a.y < 0.0 && b.y >= 0.0);
    sides_[0].set(i, b - a, turn);
    sides_[1].set(i, -b, 0.0);
    sides_[2].set(i, a, 0.0);
    flat_reach_ = std::max(flat_reach_, static_cast<float>(std::abs(b.x) + std::abs(b.y)));
    flat_reach_ = std::max(flat_reach_, static_cast<float>(std::abs(a.x) + std::abs(a.y)));
    a = b;
  }
  is_graph_ = rounds <= (fan.is_closed() ? 1U : 0U);
}

/// `p`: relative to the vertex.
glm::dvec2 IntersectionGuard::flattened(const glm::dvec3& p) const {
  return {glm::dot(p, axes_[0]), glm::dot(p, axes_[1])};
}

/// Pre: the fan is placed.
IntersectionGuard::NearTriangle IntersectionGuard::near_triangle(
    const analysis::ExactTriangle& t, const std::array<Vertex, 3>& corner) const {
  NearTriangle result{.corner = corner};
  for (std::size_t c = 0; c < 3; ++c) {
    const glm::vec3 p(t[c] - triangles_[0][0]);
    result.position[c] = p;
    result.reach = std::max(result.reach, static_cast<float>(taxicab_length(glm::dvec3(p))));
  }
  const glm::dvec3 normal = glm::cross(t[1] - t[0], t[2] - t[0]);
  const double length = taxicab_length(normal);
  const double of_sides = taxicab_length(t[1] - t[0]) * taxicab_length(t[2] - t[0]);
  result.normal_length = length > kSliver * of_sides ? static_cast<float>(length)
                                                     : std::numeric_limits<float>::infinity();
  result.normal = glm::vec3(normal);
  result.offset = static_cast<float>(glm::dot(normal, t[0] - triangles_[0][0]));
  return result;
}

IntersectionGuard::SharedCorners IntersectionGuard::shared_corners(const Fan& fan, std::size_t i,
                                                                   const NearTriangle& other) {
  Int4 begins;
  Int4 ends;
  std::memcpy(&begins, &fan.ring()[i], sizeof(begins));
  const std::size_t last = std::min(i + 4, fan.size());
  for (std::size_t lane = 0; lane < 4; ++lane)
    ends[lane] = static_cast<std::int32_t>(fan.ring()[std::min(i + lane + 1, last)].index());
  SharedCorners shared;
  for (std::size_t c = 0; c < 3; ++c) {
    const Int4 id = Int4{} + static_cast<std::int32_t>(other.corner[c].index());
    shared.is_begin[c] = begins == id;
    shared.is_end[c] = ends == id;
  }
  return shared;
}

/// Returns which of new faces i to i + 3 are certainly on one side of the other triangle's plane,
/// or have it on one side of theirs, except for shared corners. They meet at most there. Lanes past
/// the last face are unspecified.
Int4 IntersectionGuard::find_one_sided(std::size_t i, const SharedCorners& shared,
                                       const NearTriangle& other) const {
  const Float4 zero{};
  const float reach = std::max(reach_, other.reach);
  const Float4 doubt = normals_.lengths(i) * (zero + kSideMargin * reach) + kLeastDoubt;
  Int4 is_above = kAlways;
  Int4 is_below = kAlways;
  for (std::size_t c = 0; c < 3; ++c) {
    const Float4 distance = normals_.dots(i, other.position[c]);
    const Int4 is_shared = shared.is_begin[c] | shared.is_end[c];
    is_above &= is_shared | (distance > doubt);
    is_below &= is_shared | (distance < -doubt);
  }
  const Int4 is_other_aside = is_above | is_below;
  if (!any(~is_other_aside)) return is_other_aside;
  const Float4 begins = ring_.dots(i, other.normal) - other.offset;
  const Float4 ends = ring_.dots(i + 1, other.normal) - other.offset;
  const Int4 is_begin = shared.is_begin[0] | shared.is_begin[1] | shared.is_begin[2];
  const Int4 is_end = shared.is_end[0] | shared.is_end[1] | shared.is_end[2];
  const float other_doubt = kSideMargin * reach * other.normal_length + kLeastDoubt;
  const Float4 most = zero + other_doubt;
  if (-other.offset > other_doubt) {
    return is_other_aside | ((is_begin | (begins > most)) & (is_end | (ends > most)));
  }
  if (-other.offset < -other_doubt) {
    return is_other_aside | ((is_begin | (begins < -most)) & (is_end | (ends < -most)));
  }
  return is_other_aside;
}

/// Returns which of new faces i to i + 3 are certainly separated from a triangle by one of their
/// sides, in the projection along the mean normal. The plane through that side along the normal
/// then separates the two in space, and they meet at most in shared corners on that side. Lanes
/// past the last face are unspecified. Pre: the new faces form a graph.
Int4 IntersectionGuard::find_apart(std::size_t i, const SharedCorners& shared,
                                   const NearTriangle& other) const {
  std::array<glm::vec2, 3> corner;
  float reach = std::max(flat_reach_, other.reach);
  for (std::size_t c = 0; c < 3; ++c) {
    corner[c] = glm::vec2(flattened(glm::dvec3(other.position[c])));
    reach = std::max(reach, std::abs(corner[c].x) + std::abs(corner[c].y));
  }
  const Float4 zero{};
  Int4 is_apart{};
  for (std::size_t side = 0; side < 3; ++side) {
    const Float4 doubt = sides_[side].lengths(i) * (zero + kSideMargin * reach);
    Int4 is_outside = kAlways;
    for (std::size_t c = 0; c < 3; ++c) {
      // A shared corner may be on the side.
      const Int4 is_begin = side == 1 ? Int4{} : shared.is_begin[c];
      const Int4 is_end = side == 2 ? Int4{} : shared.is_end[c];
      const Float4 inside = sides_[side].distances(i, corner[c].x, corner[c].y);
      is_outside &= is_begin | is_end | (inside < -doubt);
    }
    is_apart |= is_outside;
  }
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
      if (is_new_pair(triangles_[i], triangles_[k],
                      analysis::exact_triangle(mesh, Mesh::face(fan.spokes()[i])),
                      analysis::exact_triangle(mesh, Mesh::face(fan.spokes()[k])))) {
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
  std::array<Vertex, 3> corner;
  analysis::ExactTriangle t;
  for (std::uint32_t c = 0; c < 3; ++c) {
    corner[c] = mesh.origin(Mesh::halfedge(other, c));
    t[c] = mesh.position(corner[c]);
  }
  const NearTriangle near = near_triangle(t, corner);
  for (std::size_t i = 0; i < fan.size(); i += 4) {
    const SharedCorners shared = shared_corners(fan, i, near);
    Int4 is_apart = find_one_sided(i, shared, near);
    if (is_graph_ && any(~is_apart)) is_apart |= find_apart(i, shared, near);
    if (!any(~is_apart)) continue;
    for (std::size_t lane = 0; lane < 4 && i + lane < fan.size(); ++lane) {
      const std::size_t k = i + lane;
      if (is_apart[lane] != 0 || !do_overlap(boxes_[k], box)) continue;
      if (analysis::is_degenerate(t)) return false;
      const analysis::ExactTriangle before =
          analysis::exact_triangle(mesh, Mesh::face(fan.spokes()[k]));
      if (is_new_pair(triangles_[k], t, before, t)) return true;
    }
  }
  return false;
}

void IntersectionGuard::collapsed(const Surface& surface, const Fan& fan) {
  for (const Halfedge spoke : fan.spokes()) {
    const Face f = Mesh::face(spoke);
    tree_.move(f, LaneBox(face_box(surface.mesh(), f)));
  }
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
