#include "engine/analysis/overlay_walk.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

namespace mesher {
namespace {

constexpr double kInfinite = std::numeric_limits<double>::infinity();
// Rounding takes less than a tenth of that from a product of two coordinates.
constexpr double kMargin = 1e-13;
constexpr int kMostSteps = 64;

/// Twice the signed area of a triangle, seen along the third axis.
double turn(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

double extent(const glm::dvec3& p) {
  return std::max(std::abs(p.x), std::abs(p.y));
}

}  // namespace

OverlayWalk::Projected OverlayWalk::projected(Vertex v) const {
  const glm::dvec3 q = glm::dvec3(surface_.position(v)) - origin_;
  return {glm::dot(q, axes_[0]), glm::dot(q, axes_[1]), glm::dot(q, axes_[2])};
}

Face OverlayWalk::locate(const std::array<glm::dvec3, 3>& triangle, Face hint) {
  origin_ = triangle[0];
  const glm::dvec3 ab = triangle[1] - origin_;
  const glm::dvec3 ac = triangle[2] - origin_;
  const glm::dvec3 normal = glm::cross(ab, ac);
  const double length = glm::length(ab);
  const double twice_area = glm::length(normal);
  size_ = std::max(length, glm::length(ac));
  // Of slivers the plane is uncertain, and the middle may be outside.
  if (!(twice_area > 1e-6 * size_ * size_)) return {};
  axes_[0] = ab / length;
  axes_[2] = normal / twice_area;
  axes_[1] = glm::cross(axes_[2], axes_[0]);
  corners_ = {
      Projected(0.0), {length, 0.0, 0.0}, {glm::dot(ac, axes_[0]), twice_area / length, 0.0}};
  const Projected middle = (corners_[0] + corners_[1] + corners_[2]) / 3.0;
  Halfedge h = Mesh::halfedge(hint);
  std::array<Projected, 3> p;
  for (std::uint32_t c = 0; c < 3; ++c)
    p[c] = projected(surface_.origin(Mesh::halfedge(hint, c)));
  for (int step = 0; step < kMostSteps; ++step) {
    if (turn(p[0], p[1], p[2]) <= 0.0) return {};
    const std::array<double, 3> side{turn(p[0], p[1], middle), turn(p[1], p[2], middle),
                                     turn(p[2], p[0], middle)};
    const auto out =
        static_cast<std::size_t>(std::min_element(side.begin(), side.end()) - side.begin());
    if (side[out] >= 0.0) return Mesh::face(h);
    const Halfedge over = out == 0 ? h : out == 1 ? Mesh::next(h) : Mesh::prev(h);
    h = surface_.twin(over);
    if (!h.is_valid()) return {};
    p = {p[(out + 1) % 3], p[out], projected(surface_.origin(Mesh::prev(h)))};
  }
  return {};
}

/// Whether a segment meets the triangle, seen along its normal; also where that is in doubt.
bool OverlayWalk::meets(const Projected& from, const Projected& to) const {
  const double most = std::max({size_, extent(from), extent(to)});
  const double margin = 8.0 * kMargin * most * most;
  bool is_left = true;
  bool is_right = true;
  for (std::size_t c = 0; c < 3; ++c) {
    const Projected& a = corners_[c];
    const Projected& b = corners_[(c + 1) % 3];
    if (std::max(turn(a, b, from), turn(a, b, to)) < -margin) return false;
    const double side = turn(from, to, a);
    is_left &= side > margin;
    is_right &= side < -margin;
  }
  return !is_left && !is_right;
}

/// A bound for the heights of the part of a face that is over the triangle: those of its corners,
/// or of its plane over the triangle's, which is not looked at where those are low `enough`.
double OverlayWalk::height(const std::array<Projected, 3>& face, double turn_of_face,
                           double enough) const {
  const auto& [p, q, r] = face;
  const double of_corners = std::max({std::abs(p.z), std::abs(q.z), std::abs(r.z)});
  if (of_corners <= enough) return of_corners;
  double of_plane = 0.0;
  for (const Projected& corner : corners_) {
    const double z = turn(corner, q, r) * p.z + turn(p, corner, r) * q.z + turn(p, q, corner) * r.z;
    of_plane = std::max(of_plane, std::abs(z));
  }
  return std::min(of_corners, of_plane / turn_of_face);
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

/// Goes on over a side of a face, if it meets the triangle. False at a boundary.
bool OverlayWalk::cross(Halfedge h, const Projected& from, const Projected& to) {
  if (!meets(from, to)) return true;
  const Halfedge other = surface_.twin(h);
  if (!other.is_valid()) return false;
  stack_.push_back({other, to, from});
  return true;
}

double OverlayWalk::bound(Face start, double most) {
  ++walk_;
  faces_ = 0;
  stack_.clear();
  double highest = 0.0;
  const Halfedge first = Mesh::halfedge(start);
  const Projected p = projected(surface_.origin(first));
  const Projected q = projected(surface_.target(first));
  stack_.push_back({first, p, q});
  if (!cross(first, p, q)) return kInfinite;
  while (!stack_.empty()) {
    // The first face's other half may come first: all that counts is what has been visited.
    const auto [h, from, to] = stack_.back();
    stack_.pop_back();
    if (!is_new(Mesh::face(h))) continue;
    if (++faces_ > kMostFaces) return kInfinite;
    const Projected apex = projected(surface_.origin(Mesh::prev(h)));
    const double area = turn(from, to, apex);
    const double extent_of_face = std::max({size_, extent(from), extent(to), extent(apex)});
    if (!(area > 8.0 * kMargin * extent_of_face * extent_of_face)) return kInfinite;
    highest = std::max(highest, height({from, to, apex}, area, most));
    if (highest > most) return kInfinite;
    if (!cross(Mesh::next(h), to, apex)) return kInfinite;
    if (!cross(Mesh::prev(h), apex, from)) return kInfinite;
  }
  return highest;
}

}  // namespace mesher
