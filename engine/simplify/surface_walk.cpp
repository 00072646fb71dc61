#include "engine/simplify/surface_walk.h"

#include <algorithm>
#include <glm/geometric.hpp>

#include "engine/analysis/surface_point.h"

namespace mesher::simplify {
namespace {

// A walk ends when so many faces in a row were not nearer.
constexpr int kPatience = 12;
// Squared ratio of distances within which faces are in the vicinity of a point.
constexpr double kVicinity2 = 4.0;
// Faces between the ends of two walks that lead to one place, at most.
constexpr std::size_t kMostBetween = 256;
// Squared ratio of distances from which on a walk is lost.
constexpr double kLost2 = 4.0;
constexpr std::size_t kMostNear = 64;

NearPoint nearest_on_face(const Mesh& mesh, Face f, const glm::dvec3& p) {
  const std::array<glm::dvec3, 3> t = analysis::corners_of(mesh, f);
  const glm::dvec3 w = analysis::nearest_weights(p, t);
  const glm::dvec3 off = p - (w.x * t[0] + w.y * t[1] + w.z * t[2]);
  return {f, w, glm::dot(off, off)};
}

/// Returns the chart of each face.
std::vector<std::uint32_t> charts(const Mesh& mesh, const Lines& lines) {
  std::vector<std::uint32_t> chart(mesh.face_count(), kNone);
  std::vector<Face> pending;
  std::uint32_t count = 0;
  for (std::uint32_t seed = 0; seed < mesh.face_count(); ++seed) {
    if (chart[seed] != kNone) continue;
    chart[seed] = count;
    pending.assign(1, Face(seed));
    while (!pending.empty()) {
      const Face f = pending.back();
      pending.pop_back();
      for (std::uint32_t c = 0; c < 3; ++c) {
        const Halfedge h = Mesh::halfedge(f, c);
        const Halfedge t = mesh.twin(h);
        if (!t.is_valid() || lines[h]) continue;
        std::uint32_t& other = chart[Mesh::face(t).index()];
        if (other != kNone) continue;
        other = count;
        pending.push_back(Mesh::face(t));
      }
    }
    ++count;
  }
  return chart;
}

}  // namespace

NearPoint SurfaceWalk::nearest(Face start, const glm::dvec3& p) {
  begin();
  const auto is_further = [](const NearPoint& a, const NearPoint& b) {
    return a.distance2 > b.distance2;
  };
  const auto visit = [&](Face f) {
    visited_.push_back(f);
    front_.push_back(nearest_on_face(mesh_, f, p));
    std::push_heap(front_.begin(), front_.end(), is_further);
  };
  visit(start);
  NearPoint best;
  for (int worse = 0; !front_.empty() && worse < kPatience && best.distance2 > 0.0;) {
    std::pop_heap(front_.begin(), front_.end(), is_further);
    const NearPoint at = front_.back();
    front_.pop_back();
    if (at.distance2 > kVicinity2 * best.distance2) break;
    if (at.distance2 < best.distance2) {
      best = at;
      worse = 0;
    } else {
      ++worse;
    }
    for_each_neighbor(at.face, visit);
  }
  return best;
}

bool SurfaceWalk::are_connected(const NearPoint& a, const NearPoint& b, const glm::dvec3& p) {
  if (a.face == b.face) return true;
  const double reach2 = kVicinity2 * std::max(a.distance2, b.distance2);
  begin();
  visited_.push_back(a.face);
  bool is_found = false;
  for (std::size_t i = 0; i < visited_.size() && !is_found; ++i) {
    if (visited_.size() >= kMostBetween) break;
    for_each_neighbor(visited_[i], [&](Face f) {
      is_found |= f == b.face;
      if (nearest_on_face(mesh_, f, p).distance2 <= reach2) visited_.push_back(f);
    });
  }
  return is_found;
}

void SurfaceWalk::begin() {
  visited_.clear();
  front_.clear();
}

/// Calls `visit` for the neighbors that were not visited.
template <class Visit>
void SurfaceWalk::for_each_neighbor(Face f, Visit&& visit) {
  for (std::uint32_t c = 0; c < 3; ++c) {
    const Halfedge h = Mesh::halfedge(f, c);
    const Halfedge t = mesh_.twin(h);
    if (!t.is_valid() || lines_[h]) continue;
    const Face other = Mesh::face(t);
    if (std::find(visited_.rbegin(), visited_.rend(), other) == visited_.rend()) visit(other);
  }
}

WalkRescue::WalkRescue(const Mesh& mesh, const Lines& lines)
    : mesh_(mesh), tree_(mesh), chart_(charts(mesh, lines)) {}

std::optional<Face> WalkRescue::nearer(const NearPoint& end, const glm::dvec3& p) const {
  const auto [nearest, nearest2] = tree_.nearest(p, end.face);
  if (end.distance2 <= kLost2 * nearest2) return std::nullopt;
  std::vector<Face> near{nearest};
  tree_.within(p, kLost2 * nearest2, kMostNear, near);
  NearPoint best{.face = end.face, .distance2 = end.distance2};
  for (const Face f : near) {
    if (chart_[f.index()] != chart_[end.face.index()]) continue;
    const NearPoint point = nearest_on_face(mesh_, f, p);
    if (point.distance2 < best.distance2) best = point;
  }
  if (best.distance2 >= end.distance2) return std::nullopt;
  return best.face;
}

}  // namespace mesher::simplify
