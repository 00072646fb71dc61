#include "engine/simplify/intersection_guard.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <utility>

namespace mesher {
namespace {

ExactTriangle triangle(const Mesh& mesh, Face f) {
  return {mesh.position(mesh.origin(Mesh::halfedge(f, 0))),
          mesh.position(mesh.origin(Mesh::halfedge(f, 1))),
          mesh.position(mesh.origin(Mesh::halfedge(f, 2)))};
}

/// Pre: `changed` is not degenerate.
bool is_new_pair(const ExactTriangle& changed, const ExactTriangle& other,
                 const ExactTriangle& before, const ExactTriangle& other_before) {
  if (!do_intersect(changed, other)) return false;
  return is_degenerate(before) || is_degenerate(other_before) ||
         !do_intersect(before, other_before);
}

/// The faces all of whose corners are of the region, in the order of their vertices.
std::vector<Face> faces_of(const Surface& surface, std::uint32_t region,
                           std::span<const Vertex> vertices) {
  const Mesh& mesh = surface.mesh();
  std::vector<Face> faces;
  faces.reserve(2 * vertices.size());
  for (const Vertex v : vertices) {
    if (mesh.is_isolated(v)) continue;
    const Halfedge start = mesh.outgoing(v);
    Halfedge h = start;
    do {
      const Vertex a = mesh.target(h);
      const Vertex b = mesh.origin(Mesh::prev(h));
      // Each face once, by its lowest corner.
      if (v < a && v < b && surface.state(a).region == region &&
          surface.state(b).region == region) {
        faces.push_back(Mesh::face(h));
      }
      h = mesh.rotate_ccw(h);
    } while (h.is_valid() && h != start);
  }
  return faces;
}

}  // namespace

IntersectionGuard::IntersectionGuard(const Surface& surface, GuardedSpace& space,
                                     std::uint32_t region, std::span<const Vertex> vertices)
    : space_(space), region_(region), tree_(space.place_of) {
  tree_.build(surface, faces_of(surface, region, vertices));
}

/// The faces of the fan with the vertex at `p`.
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

/// Whether the new faces certainly do not intersect one another: along the mean of their normals
/// all of them are seen from the front, and they go around their vertex no more than once. The
/// margin is far above what rounding may do, so that this need not be exact.
bool IntersectionGuard::is_graph(const Fan& fan, const glm::dvec3& mean) const {
  constexpr double kMargin = 1e-6;
  const double least = kMargin * glm::dot(mean, mean) / static_cast<double>(triangles_.size());
  const glm::dvec3& up = axes_[1];
  const auto is_below = [&](const ExactTriangle& t, std::size_t corner) {
    return glm::dot(up, t[corner] - t[0]) < 0.0;
  };
  // From below to above: as often as the faces go around.
  std::size_t rounds = 0;
  for (const ExactTriangle& t : triangles_) {
    const glm::dvec3 normal = glm::cross(t[1] - t[0], t[2] - t[0]);
    if (!(glm::dot(normal, mean) > least)) return false;
    rounds += static_cast<std::size_t>(is_below(t, 1) && !is_below(t, 2));
  }
  return rounds <= (fan.is_closed() ? 1U : 0U);
}

/// Projects the new faces along the mean of their normals, their vertex to the origin.
void IntersectionGuard::flatten(const Fan& fan) {
  glm::dvec3 mean(0.0);
  for (const ExactTriangle& t : triangles_)
    mean += glm::cross(t[1] - t[0], t[2] - t[0]);
  mean /= std::sqrt(glm::dot(mean, mean));
  const bool is_x_across = std::abs(mean.x) < std::abs(mean.y);
  axes_[0] = glm::cross(is_x_across ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0), mean);
  axes_[1] = glm::cross(mean, axes_[0]);
  is_graph_ = is_graph(fan, mean);
  if (!is_graph_) return;
  flat_.resize(triangles_.size());
  for (std::size_t i = 0; i < triangles_.size(); ++i)
    flat_[i] = flattened(triangles_[i]);
}

IntersectionGuard::FlatTriangle IntersectionGuard::flattened(const ExactTriangle& t) const {
  const glm::dvec3& origin = triangles_[0][0];
  FlatTriangle flat;
  for (std::size_t c = 0; c < 3; ++c) {
    const glm::dvec3 q = t[c] - origin;
    flat[c] = {glm::dot(q, axes_[0]), glm::dot(q, axes_[1])};
  }
  return flat;
}

/// Whether a side of a new face certainly separates it from a triangle, seen along the mean of the
/// normals: then a wall on that side does so in space, and the two meet in the corners on the side
/// that they share, at most.
bool IntersectionGuard::is_apart(std::size_t i, const ExactTriangle& other,
                                 const FlatTriangle& flat) const {
  constexpr double kMargin = 1e-12;
  const ExactTriangle& triangle = triangles_[i];
  const FlatTriangle& face = flat_[i];
  // The side across from the vertex first: mostly that one.
  for (const auto& [from, to] : {std::array{1U, 2U}, {2U, 0U}, {0U, 1U}}) {
    const glm::dvec2& a = face[from];
    const glm::dvec2 side = face[to] - a;
    bool is_beyond = true;
    for (std::size_t c = 0; c < 3 && is_beyond; ++c) {
      if (other[c] == triangle[from] || other[c] == triangle[to]) continue;
      const glm::dvec2& q = flat[c];
      const glm::dvec2 way = q - a;
      const double left = side.x * way.y;
      const double right = side.y * way.x;
      const double reach = std::abs(a.x) + std::abs(a.y) + std::abs(q.x) + std::abs(q.y);
      const double margin = kMargin * (std::abs(side.x) + std::abs(side.y)) * reach;
      is_beyond = left - right < -margin;
    }
    if (is_beyond) return true;
  }
  return false;
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

/// Whether two faces of the fan would intersect that do not yet.
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

/// Whether a face of the fan would intersect `other`, and does not yet.
bool IntersectionGuard::has_new_pair(const Surface& surface, const Fan& fan, Face other,
                                     const LaneBox& box) const {
  const Mesh& mesh = surface.mesh();
  const ExactTriangle t = triangle(mesh, other);
  const FlatTriangle flat = flattened(t);
  for (std::size_t i = 0; i < fan.size(); ++i) {
    if (!do_overlap(boxes_[i], box)) continue;
    if (is_graph_ && is_apart(i, t, flat)) continue;
    if (is_degenerate(t)) return false;
    if (is_new_pair(triangles_[i], t, triangle(mesh, Mesh::face(fan.spokes()[i])), t)) return true;
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

}  // namespace mesher
