#pragma once

#include <algorithm>
#include <array>
#include <span>

#include "engine/simplify/cost_policy.h"
#include "engine/simplify/fan.h"
#include "engine/simplify/surface.h"

namespace mesher::simplify {

/// Eight edges that may be merged anywhere and are not features.
using EightHalfedges = std::array<Halfedge, 8>;

/// Collects edges and evaluates them in batches of eight. `Eight`: returns a Float8 of costs for
/// EightHalfedges.
template <class Eight>
class EightEdges {
 public:
  EightEdges(const Eight& evaluate, float* costs) : evaluate_(evaluate), costs_(costs) {}

  void add(Halfedge h, std::size_t index) {
    edges_[count_] = h;
    indices_[count_] = index;
    if (++count_ == 8) flush();
  }

  void flush() {
    if (count_ == 0) return;
    std::fill(edges_.begin() + static_cast<std::ptrdiff_t>(count_), edges_.end(), edges_[0]);
    const Float8 found = evaluate_(edges_);
    std::array<float, 8> all{};
    store4(all.data(), found.low);
    store4(all.data() + 4, found.high);
    for (std::size_t lane = 0; lane < count_; ++lane)
      costs_[indices_[lane]] = all[lane];
    count_ = 0;
  }

 private:
  const Eight& evaluate_;
  float* costs_;
  EightHalfedges edges_{};
  std::array<std::size_t, 8> indices_{};
  std::size_t count_ = 0;
};

/// Evaluates edges: eight at a time if they may be merged anywhere, the others one by one. `One`:
/// returns the cost for a half-edge and its AllowedPlacement.
template <class Eight, class One>
void evaluate_edges(const Surface& surface, std::span<const Halfedge> edges, const Eight& eight,
                    const One& one, float* costs) {
  EightEdges<Eight> batch(eight, costs);
  for (std::size_t i = 0; i < edges.size(); ++i) {
    const AllowedPlacement allowed =
        surface.is_constrained() ? surface.allowed_placement(edges[i]) : AllowedPlacement::anywhere;
    if (allowed == AllowedPlacement::anywhere && !surface.is_feature(edges[i])) {
      batch.add(edges[i], i);
    } else {
      costs[i] = allowed == AllowedPlacement::nowhere ? kNever : one(edges[i], allowed);
    }
  }
  batch.flush();
}

template <class F>
StateLanes<F> broadcast_state(const VertexState& s) {
  const auto all = [](float x) { return broadcast<F>(x); };
  const Quadric<float>& q = s.quadric;
  return {{all(q.xx),
           all(q.xy),
           all(q.xz),
           all(q.yy),
           all(q.yz),
           all(q.zz),
           {all(q.g.x), all(q.g.y), all(q.g.z)}},
          {all(s.position.x), all(s.position.y), all(s.position.z)}};
}

/// Evaluates the edges from the vertex of a smooth fan to its neighbors, eight at a time. `Eight`:
/// returns a Float8 of costs for the states at both ends, EightHalfedges, and the index of the
/// first of them in the fan. May write up to eight values past the end.
template <class Eight>
void evaluate_spokes(const Surface& surface, Vertex v, const Fan& fan, const Eight& eight,
                     float* costs) {
  const StateLanes<Float8> from = broadcast_state<Float8>(surface.state(v));
  for (std::size_t i = 0; i < fan.size(); i += 8) {
    std::array<Vertex, 8> neighbors;
    EightHalfedges edges;
    for (std::size_t lane = 0; lane < 8; ++lane) {
      neighbors[lane] = fan.ring()[std::min(i + lane, fan.size())];
      edges[lane] = fan.spokes()[std::min(i + lane, fan.size() - 1)];
    }
    const Float8 found = eight(from, surface.states(neighbors), edges, i);
    store4(costs + i, found.low);
    store4(costs + i + 4, found.high);
  }
}

/// Returns the quadrics of eight spokes of a smooth fan, from the states at their ends.
inline EdgeQuadric<Float8> spoke_quadrics(const Fan& fan, std::size_t first,
                                          const StateLanes<Float8>& from,
                                          const StateLanes<Float8>& to) {
  const Vec3<Float8> shared = fan.area_vectors_before(first) + fan.area_vectors(first);
  return {from.quadric, to.quadric, shared, to.position - from.position};
}

}  // namespace mesher::simplify
