#include "engine/subdivide/butterfly.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <unordered_map>
#include <utility>
#include <vector>

#include "engine/core/parallel.h"
#include "engine/subdivide/refine.h"
#include "engine/subdivide/sharpness.h"

namespace mesher::subdivide {
namespace {

constexpr std::size_t kButterflyGrain = 4096;
// From this valence on, the stencils around a vertex are computed together.
constexpr std::uint32_t kButterflyHubValence = 33;

/// Sharp edges and vertices by index, for stencils. `sharpness` is empty if only boundaries are
/// sharp.
struct SharpLookup {
  Array<float> sharpness;              ///< 3F
  std::vector<std::uint8_t> is_curve;  ///< V: the vertex is on a crease or is sharp

  SharpLookup(const LevelView& level, const Features& features) {
    const bool has_creases = std::ranges::any_of(features.edges(), [&](const SharpEdge& edge) {
      return level.twin[edge.h.index()].is_valid();
    });
    if (has_creases) {
      sharpness.assign(level.origin.size(), 0.0F);
      for (const SharpEdge& edge : features.edges()) {
        sharpness[edge.h.index()] = edge.sharpness;
        const Halfedge twin = level.twin[edge.h.index()];
        if (twin.is_valid()) sharpness[twin.index()] = edge.sharpness;
      }
    }
    is_curve.assign(level.position.size(), 0);
    for (const SharpVertex& vertex : features.vertices()) {
      if (vertex.count > 1 || vertex.own > 0.0F) is_curve[vertex.v.index()] = 1;
    }
  }
};

/// All stencils around a vertex of high valence. The weights of neighbor j for the edge to neighbor
/// i are cosines of j - i, so a few sums over the ring serve every edge: O(1) per edge, where
/// summing each stencil would be O(valence).
class HubStencils {
 public:
  /// Sums the ring counterclockwise, from any spoke.
  HubStencils(const LevelView& level, Halfedge start) {
    Halfedge h = start;
    do {
      spoke_indices_.emplace_back(h, static_cast<std::uint32_t>(spoke_indices_.size()));
      h = level.twin[Mesh::prev(h).index()];
    } while (h != start);
    for (const auto& [spoke, j] : spoke_indices_) {
      const glm::dvec3 end = level.position[level.origin[Mesh::next(spoke).index()].index()];
      sum_ += end;
      for (std::size_t k = 0; k < 2; ++k) {
        cos_[k] += std::cos(angle(k, j)) * end;
        sin_[k] += std::sin(angle(k, j)) * end;
      }
    }
    std::ranges::sort(spoke_indices_);
  }

  /// Returns the ring's contribution to the new vertex on the edge of `h`, which leaves the hub.
  glm::dvec3 ring_part(Halfedge h) const {
    const std::uint32_t i =
        std::ranges::lower_bound(spoke_indices_, h, {}, &std::pair<Halfedge, std::uint32_t>::first)
            ->second;
    const auto wave = [&](std::size_t k) {
      return std::cos(angle(k, i)) * cos_[k] + std::sin(angle(k, i)) * sin_[k];
    };
    return (0.25 * sum_ + wave(0) + 0.5 * wave(1)) / static_cast<double>(spoke_indices_.size());
  }

 private:
  double angle(std::size_t k, std::uint32_t j) const {
    return 2.0 * std::numbers::pi * static_cast<double>(k + 1) * j /
           static_cast<double>(spoke_indices_.size());
  }

  std::vector<std::pair<Halfedge, std::uint32_t>> spoke_indices_;  ///< spokes with ring indices
  glm::dvec3 sum_{0.0};
  std::array<glm::dvec3, 2> cos_{glm::dvec3(0.0), glm::dvec3(0.0)};
  std::array<glm::dvec3, 2> sin_{glm::dvec3(0.0), glm::dvec3(0.0)};
};

class Butterfly {
 public:
  Butterfly(const LevelView& level, const Rings& rings, const Features& features)
      : level_(level), rings_(rings), features_(features), sharp_(level, features) {
    for (std::uint32_t v = 0; v < rings.base_vertices(); ++v) {
      if (rings.base_valence(v) < kButterflyHubValence || !is_extraordinary(Vertex(v))) continue;
      hubs_.emplace(v, HubStencils(level, level.outgoing[v]));
    }
  }

  /// Returns the new vertex as if the edge itself were smooth. On a boundary, the value is
  /// arbitrary.
  glm::dvec3 smooth_point(Halfedge h, Halfedge twin) const {
    if (!twin.is_valid()) return from(h);
    const bool first = is_extraordinary(origin(h));
    const bool second = is_extraordinary(origin(twin));
    if (first && second) return 0.5 * (around(h) + around(twin));
    if (first) return around(h);
    if (second) return around(twin);
    const glm::dvec3 wings =
        wing(Mesh::next(h)) + wing(Mesh::prev(h)) + wing(Mesh::next(twin)) + wing(Mesh::prev(twin));
    return kButterflyEnd * (from(h) + from(twin)) +
           kButterflyOpposite * (opposite(h) + opposite(twin)) + kButterflyWing * wings;
  }

  /// Returns the new vertex by the four-point rule along the boundary or crease.
  glm::dvec3 curve_point(const SharpEdge& edge) const {
    const glm::dvec3 a = end(edge, 0);
    const glm::dvec3 b = end(edge, 1);
    return kFourPointEnd * (a + b) +
           kFourPointNext * (beyond(edge, 0, a, b) + beyond(edge, 1, b, a));
  }

 private:
  Vertex origin(Halfedge h) const { return level_.origin[h.index()]; }
  glm::dvec3 at(Vertex v) const { return level_.position[v.index()]; }
  glm::dvec3 from(Halfedge h) const { return at(origin(h)); }
  glm::dvec3 opposite(Halfedge h) const { return from(Mesh::prev(h)); }
  float sharpness(Halfedge h) const {
    return sharp_.sharpness.empty() ? 0.0F : sharp_.sharpness[h.index()];
  }

  bool is_extraordinary(Vertex v) const {
    return v.index() < rings_.base_vertices() && rings_.base_valence(v.index()) != 6 &&
           sharp_.is_curve[v.index()] == 0;
  }

  /// Returns the vertex across `h` from its face, blended with its reflection by the edge's
  /// sharpness.
  glm::dvec3 wing(Halfedge h) const {
    const Halfedge twin = level_.twin[h.index()];
    const glm::dvec3 reflected = from(h) + from(Mesh::next(h)) - opposite(h);
    if (!twin.is_valid()) return reflected;
    const double blend = std::min(1.0, static_cast<double>(sharpness(h)));
    if (blend <= 0.0) return opposite(twin);
    return blend * reflected + (1.0 - blend) * opposite(twin);
  }

  /// Returns the new vertex from the ring of the extraordinary vertex that `h` leaves.
  glm::dvec3 around(Halfedge h) const {
    const std::uint32_t valence = rings_.base_valence(origin(h).index());
    glm::dvec3 point = kButterflyCenter * from(h);
    if (valence >= kButterflyHubValence) return point + hubs_.at(origin(h).index()).ring_part(h);
    Halfedge spoke = h;
    for (std::uint32_t i = 0; i < valence; ++i) {
      point += butterfly_ring_weight(valence, i) * from(Mesh::next(spoke));
      spoke = level_.twin[Mesh::prev(spoke).index()];
    }
    return point;
  }

  glm::dvec3 end(const SharpEdge& edge, std::size_t side) const {
    return at(features_.vertices()[edge.end[side]].v);
  }

  /// Returns the next vertex along the curve beyond `near`, the end on that side. If the curve ends
  /// or branches there, it is extended straight.
  glm::dvec3 beyond(const SharpEdge& edge, std::size_t side, const glm::dvec3& near,
                    const glm::dvec3& far) const {
    const SharpVertex& vertex = features_.vertices()[edge.end[side]];
    if (vertex.count != 2 || vertex.own > 0.0F) return 2.0 * near - far;
    const auto edges = features_.at(vertex);
    const SharpEdge& first = features_.edges()[edges[0]];
    const SharpEdge& onward = &first == &edge ? features_.edges()[edges[1]] : first;
    return at(features_.other_end(onward, vertex).v);
  }

  const LevelView& level_;
  const Rings& rings_;
  const Features& features_;
  SharpLookup sharp_;
  std::unordered_map<std::uint32_t, HubStencils> hubs_;
};

/// Copies the old vertices, which do not move.
void copy_positions(const LevelView& coarse, Level& finer) {
  std::ranges::copy(coarse.position, finer.position.begin());
}

}  // namespace

Level butterfly_step(const LevelView& coarse, const Rings& rings, const Features& features,
                     const SubdivideOptions& options, bool is_last) {
  const Butterfly butterfly(coarse, rings, features);
  Level finer = refine(coarse, is_last, options.progress, [&](const EdgeSite& edge) {
    return Point(glm::vec3(butterfly.smooth_point(edge.h, edge.twin)));
  });
  parallel_for_each(features.edges().size(), kButterflyGrain, [&](std::uint32_t i) {
    const SharpEdge& edge = features.edges()[i];
    glm::vec3& position = finer.position[edge_vertex(finer, edge.h).index()];
    const double blend = edge_blend(edge.sharpness, edge.left[0], edge.left[1]);
    const glm::dvec3 curve = butterfly.curve_point(edge);
    position = blend >= 1.0 ? curve : blend * curve + (1.0 - blend) * glm::dvec3(position);
  });
  check_cancelled(options.progress);
  copy_positions(coarse, finer);
  if (!is_last) write_outgoing(coarse, finer);
  return finer;
}

Level midpoint_step(const LevelView& coarse, const SubdivideOptions& options, bool is_last) {
  Level finer = refine(coarse, is_last, options.progress, [&](const EdgeSite& edge) {
    return 0.5F * (coarse.from(edge.h) + coarse.from(edge.next));
  });
  check_cancelled(options.progress);
  copy_positions(coarse, finer);
  if (!is_last) write_outgoing(coarse, finer);
  return finer;
}

}  // namespace mesher::subdivide
