#include "engine/analysis/overlay_walk.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

#include "engine/analysis/triangle_tree.h"
#include "engine/mesh/circulators.h"

namespace mesher::analysis {
namespace {

constexpr double kInfinite = std::numeric_limits<double>::infinity();
// Rounding changes a sum of products of two coordinates by less than a tenth of this.
constexpr double kMargin = 1e-12;
constexpr int kMostSteps = 64;
// Limits of the search for another start, if the walk from the hint fails.
constexpr int kMostSpokes = 64;
constexpr double kLeastSlope = 0.3;

/// Returns twice the signed area of a triangle seen along the third axis.
double turn(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

/// The same with the origin (the middle) as the third corner.
double turn(const glm::dvec3& a, const glm::dvec3& b) {
  return a.x * b.y - a.y * b.x;
}

}  // namespace

OverlayWalk::Projected OverlayWalk::projected(Vertex v) const {
  const glm::dvec3 q = glm::dvec3(surface_.position(v)) - origin_;
  return {glm::dot(q, axes_[0]), glm::dot(q, axes_[1]), glm::dot(q, axes_[2])};
}

double OverlayWalk::locate(const Triangle& triangle, Face hint, double shrink) {
  const glm::dvec3 ab = triangle[1] - triangle[0];
  const glm::dvec3 ac = triangle[2] - triangle[0];
  const glm::dvec3 normal = glm::cross(ab, ac);
  const double length = glm::length(ab);
  const double twice_area = glm::length(normal);
  size_ = std::max(length, glm::length(ac));
  // The plane of a sliver is uncertain, and its middle may be outside.
  if (!(twice_area > 1e-6 * size_ * size_)) return kInfinite;
  origin_ = (triangle[0] + triangle[1] + triangle[2]) / 3.0;
  axes_[0] = ab / length;
  axes_[2] = normal / twice_area;
  axes_[1] = glm::cross(axes_[2], axes_[0]);
  for (std::size_t c = 0; c < 3; ++c) {
    const glm::dvec3 q = (1.0 - shrink) * (triangle[c] - origin_);
    corners_[c] = {glm::dot(q, axes_[0]), glm::dot(q, axes_[1]), 0.0};
  }
  const double height = walk_to_middle(hint);
  return height < kInfinite ? height : walk_from_around(hint);
}

/// If the hint is flipped, as beyond a sharp edge, starts at the nearest adjacent face that is not.
double OverlayWalk::walk_from_around(Face hint) {
  Face nearest;
  double least = kInfinite;
  for (std::uint32_t c = 0; c < 3; ++c) {
    const Vertex corner = surface_.origin(Mesh::halfedge(hint, c));
    int spokes = 0;
    for (const Halfedge h : halfedges_around(surface_, corner)) {
      if (++spokes > kMostSpokes) break;
      const Face f = Mesh::face(h);
      if (f == hint || slope(f) < kLeastSlope) continue;
      const double d = squared_distance(origin_, corners(f));
      if (d >= least) continue;
      least = d;
      nearest = f;
    }
  }
  return nearest.is_valid() ? walk_to_middle(nearest) : kInfinite;
}

Triangle OverlayWalk::corners(Face f) const {
  return {surface_.position(surface_.origin(Mesh::halfedge(f, 0))),
          surface_.position(surface_.origin(Mesh::halfedge(f, 1))),
          surface_.position(surface_.origin(Mesh::halfedge(f, 2)))};
}

/// Returns the cosine of the angle between a face of the surface and the triangle.
double OverlayWalk::slope(Face f) const {
  const auto [a, b, c] = corners(f);
  const glm::dvec3 normal = glm::cross(b - a, c - a);
  const double squared = glm::dot(normal, normal);
  return squared > 0.0 ? glm::dot(normal, axes_[2]) / std::sqrt(squared) : 0.0;
}

double OverlayWalk::walk_to_middle(Face from) {
  start_ = Mesh::halfedge(from);
  std::array<Projected, 3>& p = start_corners_;
  for (std::uint32_t c = 0; c < 3; ++c)
    p[c] = projected(surface_.origin(Mesh::halfedge(from, c)));
  for (int step = 0; step < kMostSteps; ++step) {
    // Per side, twice the area of the triangle that it forms with the middle.
    const std::array<double, 3> part{turn(p[0], p[1]), turn(p[1], p[2]), turn(p[2], p[0])};
    const double whole = part[0] + part[1] + part[2];
    if (!(whole > 0.0)) return kInfinite;
    const auto out =
        static_cast<std::size_t>(std::min_element(part.begin(), part.end()) - part.begin());
    if (part[out] >= 0.0) {
      return std::abs(part[0] * p[2].z + part[1] * p[0].z + part[2] * p[1].z) / whole;
    }
    const Halfedge over = out == 0 ? start_ : out == 1 ? Mesh::next(start_) : Mesh::prev(start_);
    start_ = surface_.twin(over);
    if (!start_.is_valid()) return kInfinite;
    p = {p[(out + 1) % 3], p[out], projected(surface_.origin(Mesh::prev(start_)))};
  }
  return kInfinite;
}

OverlayWalk::Seen OverlayWalk::seen(const Projected& at) const {
  Seen result{at, {}, std::max({size_, std::abs(at.x), std::abs(at.y)})};
  for (std::size_t c = 0; c < 3; ++c)
    result.inside[c] = sides_[c].x * at.x + sides_[c].y * at.y + sides_[c].z;
  return result;
}

/// Returns whether a segment may meet the triangle, seen along its normal; true if in doubt.
bool OverlayWalk::meets(const Seen& from, const Seen& to) const {
  const double most = std::max(from.extent, to.extent);
  const double margin = kMargin * most * most;
  for (std::size_t c = 0; c < 3; ++c) {
    if (std::max(from.inside[c], to.inside[c]) < -margin) return false;
  }
  const double a = turn(from.at, to.at, corners_[0]);
  const double b = turn(from.at, to.at, corners_[1]);
  const double c = turn(from.at, to.at, corners_[2]);
  return std::min({a, b, c}) <= margin && std::max({a, b, c}) >= -margin;
}

/// Returns an upper bound for the heights of the part of a face over the triangle; not the tightest
/// if a simpler one is at most `enough`.
double OverlayWalk::height(const std::array<Projected, 3>& face, double turn_of_face,
                           double enough) const {
  const auto& [p, q, r] = face;
  const double of_corners = std::max({std::abs(p.z), std::abs(q.z), std::abs(r.z)});
  if (of_corners <= enough) return of_corners;
  // The triangle's corners, at the heights of the face's plane.
  std::array<Projected, 9> part;
  double of_plane = 0.0;
  for (std::size_t c = 0; c < 3; ++c) {
    part[c] = corners_[c];
    part[c].z =
        (turn(part[c], q, r) * p.z + turn(p, part[c], r) * q.z + turn(p, q, part[c]) * r.z) /
        turn_of_face;
    of_plane = std::max(of_plane, std::abs(part[c].z));
  }
  if (of_plane <= enough) return of_plane;
  return std::min(of_corners, height_of_common_part(face, part));
}

/// Clips the triangle to the face and returns the largest height. Rounding moves the cuts along the
/// plane by less than the allowance for distances.
double OverlayWalk::height_of_common_part(const std::array<Projected, 3>& face,
                                          std::array<Projected, 9>& part) {
  std::size_t count = 3;
  for (std::size_t side = 0; side < 3; ++side) {
    const Projected& a = face[side];
    const Projected& b = face[(side + 1) % 3];
    std::array<Projected, 9> cut;
    std::size_t left = 0;
    for (std::size_t i = 0; i < count; ++i) {
      const Projected& from = part[i];
      const Projected& to = part[(i + 1) % count];
      const double before = turn(a, b, from);
      const double after = turn(a, b, to);
      if (before >= 0.0) cut[left++] = from;
      if ((before >= 0.0) != (after >= 0.0)) {
        cut[left++] = from + before / (before - after) * (to - from);
      }
    }
    part = cut;
    count = left;
  }
  double highest = 0.0;
  for (std::size_t i = 0; i < count; ++i)
    highest = std::max(highest, std::abs(part[i].z));
  return highest;
}

bool OverlayWalk::is_new(Face f) {
  for (std::size_t at = (f.index() * 2654435761U) >> 21U;; at = (at + 1) % kSlots) {
    Slot& slot = visited_[at];
    if (slot.walk != walk_) {
      slot = {f, walk_};
      return true;
    }
    if (slot.face == f) return false;
  }
}

/// Continues across a side of a face if the side meets the triangle. Returns false at a boundary.
bool OverlayWalk::cross(Halfedge h, const Seen& from, const Seen& to) {
  if (!meets(from, to)) return true;
  const Halfedge other = surface_.twin(h);
  if (!other.is_valid()) return false;
  stack_.push_back({other, to, from});
  return true;
}

double OverlayWalk::bound(double most) {
  ++walk_;
  faces_ = 0;
  stack_.clear();
  double highest = 0.0;
  for (std::size_t c = 0; c < 3; ++c) {
    const Projected& a = corners_[c];
    const glm::dvec3 along = corners_[(c + 1) % 3] - a;
    sides_[c] = {-along.y, along.x, along.y * a.x - along.x * a.y};
  }
  const Seen first = seen(start_corners_[0]);
  const Seen second = seen(start_corners_[1]);
  stack_.push_back({start_, first, second});
  if (!cross(start_, first, second)) return kInfinite;
  // The other half of the first edge may be visited first; only the final set of visited faces
  // matters.
  while (!stack_.empty()) {
    const auto [h, from, to] = stack_.back();
    stack_.pop_back();
    if (!is_new(Mesh::face(h))) continue;
    if (++faces_ > kMostFaces) return kInfinite;
    const Seen apex = seen(projected(surface_.origin(Mesh::prev(h))));
    const double area = turn(from.at, to.at, apex.at);
    const double longest = std::max({from.extent, to.extent, apex.extent});
    if (!(area > kMargin * longest * longest)) return kInfinite;
    highest = std::max(highest, height({from.at, to.at, apex.at}, area, most));
    if (highest > most) return kInfinite;
    if (!cross(Mesh::next(h), to, apex)) return kInfinite;
    if (!cross(Mesh::prev(h), apex, from)) return kInfinite;
  }
  return highest;
}

}  // namespace mesher::analysis
