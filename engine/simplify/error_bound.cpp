#include "engine/simplify/error_bound.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <numeric>
#include <utility>
#include <vector>

#include "engine/analysis/triangle_tree.h"
#include "engine/core/parallel.h"
#include "engine/mesh/circulators.h"

namespace mesher::simplify {
namespace {

// An estimate up to this multiple of the bound is trusted: the surface is then within the bound,
// because the planes of the new faces overestimate its distance, and so does the sum over
// collapses.
constexpr double kTrusted = 1.5;
// Same for a fine bound, of which runs use only a part.
constexpr double kTrustedIfFine = 2.5;

}  // namespace

bool is_fine(const Mesh& mesh, double bound) {
  double sum = 0.0;
  for (std::uint32_t i = 0; i < mesh.halfedge_count(); ++i) {
    const Halfedge h(i);
    sum += double{glm::distance(mesh.position(mesh.origin(h)), mesh.position(mesh.target(h)))};
  }
  return 2.0 * bound * mesh.halfedge_count() < sum;
}

ErrorBound::ErrorBound(const Mesh& input, double bound, Array<float> shares)
    : input_(input),
      bound_(bound),
      next_(input.vertex_count()),
      shares_(std::move(shares)),
      estimates_(input.vertex_count(), 0.0F) {
  constexpr std::size_t kGrain = 1U << 13U;
  const bool is_fine = simplify::is_fine(input, bound);
  trusted_ = is_fine ? kTrustedIfFine : kTrusted;
  if (!is_fine) tree_.emplace(input, analysis::TriangleOrder::presorted);
  parallel_for_each(next_.size(), kGrain, [&](std::uint32_t v) { next_[v] = v; });
}

double ErrorBound::squared_distance_to(const glm::dvec3& p, Face f) const {
  const auto corner = [&](std::uint32_t c) {
    return glm::dvec3(input_.position(input_.origin(Mesh::halfedge(f, c))));
  };
  return analysis::squared_distance(p, {corner(0), corner(1), corner(2)});
}

/// Returns the nearest of a face and the three adjacent ones.
ErrorBound::Near ErrorBound::with_neighbors(const glm::dvec3& p, Near best,
                                            double squared_bound) const {
  const Face from = best.face;
  for (std::uint32_t c = 0; c < 3 && best.squared_distance > squared_bound; ++c) {
    const Halfedge t = input_.twin(Mesh::halfedge(from, c));
    if (!t.is_valid()) continue;
    const double d = squared_distance_to(p, Mesh::face(t));
    if (d < best.squared_distance) best = {Mesh::face(t), d};
  }
  return best;
}

/// Returns the nearest of a face and all faces that share a corner with it.
ErrorBound::Near ErrorBound::with_all_around(const glm::dvec3& p, Near best,
                                             double squared_bound) const {
  constexpr int kMostSpokes = 32;
  const Face from = best.face;
  for (std::uint32_t c = 0; c < 3; ++c) {
    int spokes = 0;
    for (const Halfedge h : halfedges_around(input_, input_.origin(Mesh::halfedge(from, c)))) {
      if (best.squared_distance <= squared_bound || ++spokes > kMostSpokes) break;
      const double d = squared_distance_to(p, Mesh::face(h));
      if (d < best.squared_distance) best = {Mesh::face(h), d};
    }
  }
  return best;
}

/// Walks from face to face while the distance decreases; falls back to the tree.
ErrorBound::Near ErrorBound::walk(const glm::dvec3& p, Face from, double squared_bound) const {
  constexpr int kMostSteps = 64;
  Near best{from, squared_distance_to(p, from)};
  for (int step = 0; step < kMostSteps && best.squared_distance > squared_bound; ++step) {
    const Face before = best.face;
    best = with_neighbors(p, best, squared_bound);
    if (best.face == before) best = with_all_around(p, best, squared_bound);
    if (best.face == before) break;
  }
  if (best.squared_distance <= squared_bound || !tree_) return best;
  const analysis::TriangleTree::Nearest hit = tree_->nearest_beyond(p, best.face, squared_bound);
  return {hit.face, hit.squared_distance};
}

float ErrorBound::estimate(const Surface& surface, Halfedge h, const Fan& fan,
                           const glm::vec3& p) const {
  const Mesh& mesh = surface.mesh();
  const Vertex removed = mesh.origin(h);
  const Vertex kept = mesh.target(h);
  const glm::vec3 from = mesh.position(removed) - p;
  const glm::vec3 to = mesh.position(kept) - p;
  float highest = 0.0F;
  for (std::size_t i = 0; i < fan.size(); ++i) {
    const glm::vec3 normal = fan.shape(i).normal;
    highest = std::max({highest, std::abs(glm::dot(normal, from)), std::abs(glm::dot(normal, to))});
  }
  return highest + std::max(estimates_[removed.index()], estimates_[kept.index()]);
}

bool ErrorBound::allows(const Surface& surface, Halfedge h, const Fan& fan, const glm::vec3& p,
                        float estimate) const {
  const Mesh& mesh = surface.mesh();
  const double bound = share(mesh.origin(h), mesh.target(h)) * bound_;
  return (covers_all(fan) && double{estimate} < trusted_ * bound) ||
         is_within(bound * bound, surface, h, fan, p);
}

bool ErrorBound::allows_again(const Surface& surface, const Fan& fan,
                              const CollapseStep& step) const {
  const CollapseRecord& record = step.record;
  const double bound = share(record.removed, record.kept) * bound_;
  return (step.is_plain && double{step.estimate} < trusted_ * bound) ||
         is_within(bound * bound, surface, record.halfedge, fan, record.position);
}

/// Checks the distance at points. Those of the input come first: they mostly decide.
bool ErrorBound::is_within(double squared_bound, const Surface& surface, Halfedge h, const Fan& fan,
                           const glm::vec3& p) const {
  const Mesh& mesh = surface.mesh();
  const Vertex removed = mesh.origin(h);
  const Vertex kept = mesh.target(h);
  const glm::dvec3 center(p);
  thread_local std::vector<std::array<glm::dvec3, 3>> faces;
  faces.resize(fan.size());
  for (std::size_t i = 0; i < fan.size(); ++i)
    faces[i] = {center, mesh.position(fan.ring()[i]), mesh.position(fan.ring()[i + 1])};
  std::size_t likely = 0;
  if (!reaches_all(removed, faces, squared_bound, likely) ||
      !reaches_all(kept, faces, squared_bound, likely)) {
    return false;
  }
  // A face at the vertex's place in the input is mostly near.
  const Near below = walk(center, Mesh::face(input_.outgoing(kept)), squared_bound);
  if (below.squared_distance > squared_bound) return false;
  Face hint = below.face;
  const auto is_near = [&](const glm::dvec3& q) {
    const Near hit = walk(q, hint, squared_bound);
    hint = hit.face;
    return hit.squared_distance <= squared_bound;
  };
  for (const auto& [c, a, b] : faces) {
    if (!is_near(0.5 * (c + a)) || !is_near((c + a + b) / 3.0)) return false;
  }
  // An open fan has one more edge than faces. It lies on the boundary and may cut across a hole.
  if (fan.is_closed() || fan.size() == 0) return true;
  return is_near(0.5 * (center + glm::dvec3(mesh.position(fan.ring().back()))));
}

/// Returns whether the faces pass within the bound of every input vertex that `v` represents.
/// Successive vertices of the list are mostly near the same face, so the search begins at `likely`.
bool ErrorBound::reaches_all(Vertex v, std::span<const std::array<glm::dvec3, 3>> faces,
                             double squared_bound, std::size_t& likely) const {
  const auto is_reached = [&](const glm::dvec3& q) {
    for (std::size_t k = 0; k < faces.size(); ++k) {
      const std::size_t i = likely + k < faces.size() ? likely + k : likely + k - faces.size();
      if (analysis::squared_distance(q, faces[i]) > squared_bound) continue;
      likely = i;
      return true;
    }
    return false;
  };
  std::uint32_t i = v.index();
  do {
    if (!is_reached(input_.position(Vertex(i)))) return false;
    i = next_[i];
  } while (i != v.index());
  return true;
}

void ErrorBound::collapsed(const CollapseStep& step) {
  const std::uint32_t removed = step.record.removed.index();
  const std::uint32_t kept = step.record.kept.index();
  estimates_[kept] = step.estimate;
  // Joins the two circular lists.
  std::swap(next_[removed], next_[kept]);
  if (!shares_.empty()) shares_[kept] = std::min(shares_[removed], shares_[kept]);
}

}  // namespace mesher::simplify
