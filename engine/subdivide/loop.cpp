#include "engine/subdivide/loop.h"

#include <algorithm>
#include <array>

#include "engine/core/parallel.h"
#include "engine/subdivide/refine.h"
#include "engine/subdivide/ring_masks.h"
#include "engine/subdivide/sharpness.h"

namespace mesher {
namespace {

constexpr std::size_t kGrain = 8192;

/// On a boundary edge some value; features place its vertex.
inline Point smooth_edge_point(const LevelView& level, const EdgeSite& edge) {
  const Halfedge across = edge.twin.is_valid() ? Mesh::prev(edge.twin) : edge.prev;
  const Point ends = level.from(edge.h) + level.from(edge.next);
  const Point opposites = level.from(edge.prev) + level.from(across);
  return static_cast<float>(kLoopEdgeEnd) * ends +
         static_cast<float>(kLoopEdgeOpposite) * opposites;
}

/// The six half-edges out of a vertex on an edge, as they are when it is made: in the faces that the
/// edge's two became, counter-clockwise from the half that ends where the edge ends. Row: corner of
/// the edge in its face.
constexpr std::array<std::array<std::uint32_t, 3>, 3> kSpokes{{{3, 9, 1}, {7, 10, 5}, {2, 11, 6}}};

/// Where the smooth masks put old vertices; on a boundary some value. Both ways to find the
/// neighbours add them up in the same order.
class SmoothVertices {
 public:
  SmoothVertices(const LevelView& level, std::span<const std::uint32_t> first_of_level)
      : level_(level), first_of_level_(first_of_level) {}

  void place(IndexRange vertices, Array<glm::vec3>& position) const {
    const std::size_t generations = first_of_level_.size();
    for (std::size_t i = 0; i < generations; ++i) {
      const std::size_t end = i + 1 < generations ? first_of_level_[i + 1] : vertices.end;
      const auto age = static_cast<std::uint32_t>(generations - 1 - i);
      for (std::size_t v = std::max<std::size_t>(first_of_level_[i], vertices.begin);
           v < std::min(end, vertices.end); ++v) {
        const Vertex vertex(static_cast<std::uint32_t>(v));
        (i == 0 ? walked(vertex) : computed(vertex, age)).store(position[v]);
      }
    }
  }

 private:
  Point walked(Vertex v) const {
    const Halfedge start = level_.outgoing[v.index()];
    if (!start.is_valid()) return level_.point(v);
    Point ring = level_.to(start);
    std::uint32_t valence = 1;
    Halfedge h = level_.twin[Mesh::prev(start).index()];
    for (; h != start && h.is_valid(); h = level_.twin[Mesh::prev(h).index()]) {
      ring = ring + level_.to(h);
      ++valence;
    }
    return weighted(v, masks_(valence), ring);
  }

  /// `age`: how many levels ago the vertex was made on an edge.
  Point computed(Vertex v, std::uint32_t age) const {
    const Halfedge half = level_.outgoing[v.index()];
    Halfedge other = level_.twin[half.index()];
    if (!other.is_valid()) return level_.point(v);
    for (std::uint32_t i = 0; i < age; ++i)
      other = whole_of_second(other);
    constexpr std::array<std::uint32_t, 4> kCorner{2, 0, 1, 0};  // of the edge, by child face
    const std::uint32_t child = (half.index() >> (2 * age)) / 3;
    const std::uint32_t twin = other.index() / 4;
    const auto spoke_end = [&](std::uint32_t face, std::uint32_t corner, std::uint32_t i) {
      return level_.to(Halfedge((12 * face + kSpokes[corner][i]) << (2 * age)));
    };
    Point ring = spoke_end(child / 4, kCorner[child % 4], 0);
    ring = ring + spoke_end(child / 4, kCorner[child % 4], 1);
    ring = ring + spoke_end(child / 4, kCorner[child % 4], 2);
    for (std::uint32_t i = 0; i < 3; ++i)
      ring = ring + spoke_end(twin / 3, twin % 3, i);
    return weighted(v, regular_, ring);
  }

  Point weighted(Vertex v, const RingMasks::Weights& weights, Point ring) const {
    return weights.own * level_.point(v) + weights.each * ring;
  }

  LevelView level_;
  std::span<const std::uint32_t> first_of_level_;
  RingMasks masks_{loop_vertex_mask};
  RingMasks::Weights regular_ = masks_(6);
};

glm::dvec3 point(const LevelView& level, const SharpVertex& vertex) {
  return level.position[vertex.v.index()];
}

/// Places what is sharp on one level.
class SharpStep {
 public:
  SharpStep(const LevelView& coarse, const Features& features, const SubdivideOptions& options)
      : coarse_(coarse), features_(features), rules_(options.creases) {}

  /// Pre: the new vertex is where the smooth mask has it.
  void place_on(const SharpEdge& edge, Level& finer) const {
    const SharpVertex& first = features_.vertices()[edge.end[0]];
    const SharpVertex& second = features_.vertices()[edge.end[1]];
    if (!has_sharp_mask(rules_, first.kind, second.kind)) return;
    const double weight = sharp_edge_weight(rules_, first.kind, second.kind);
    const glm::dvec3 sharp =
        weight * point(coarse_, first) + (1.0 - weight) * point(coarse_, second);
    glm::vec3& place = finer.position[edge_vertex(finer, edge.h).index()];
    const double blend = edge_blend(edge.sharpness, edge.left[0], edge.left[1]);
    place = blend >= 1.0 ? sharp : blend * sharp + (1.0 - blend) * glm::dvec3(place);
  }

  /// Pre: the vertex is where the smooth mask has it.
  void place(const SharpVertex& vertex, Level& finer) const {
    Sum before;
    Sum after;
    Transition transition;
    for (const std::uint32_t i : features_.at(vertex)) {
      const SharpEdge& edge = features_.edges()[i];
      const glm::dvec3 neighbour = point(coarse_, features_.other_end(edge, vertex));
      const float left = edge.left[features_.side(edge, vertex)];
      before.add(neighbour);
      if (left > 0.0F) after.add(neighbour);
      transition.add(edge.sharpness, left);
    }
    transition.add(vertex.own, decayed(vertex.own));
    const VertexRule rule = vertex_rule(vertex.own, before.count);
    const VertexRule next_rule = vertex_rule(decayed(vertex.own), after.count);
    if (rule == VertexRule::smooth) return;
    glm::vec3& place = finer.position[vertex.v.index()];
    const glm::dvec3 smooth = place;
    const glm::dvec3 sharper = placed(rule, vertex, before, smooth);
    if (rule == next_rule) {
      place = sharper;
    } else {
      const double weight = transition.weight();
      place = weight * sharper + (1.0 - weight) * placed(next_rule, vertex, after, smooth);
    }
  }

 private:
  struct Sum {
    glm::dvec3 sum{0.0};
    std::size_t count = 0;
    void add(const glm::dvec3& p) {
      sum += p;
      ++count;
    }
  };

  glm::dvec3 placed(VertexRule rule, const SharpVertex& vertex, const Sum& crease,
                    const glm::dvec3& smooth) const {
    if (rule == VertexRule::smooth) return smooth;
    const glm::dvec3 own = point(coarse_, vertex);
    if (rule == VertexRule::corner) return own;
    return kCreaseVertexMask.own * own + kCreaseVertexMask.each * crease.sum;
  }

  const LevelView& coarse_;
  const Features& features_;
  CreaseRules rules_;
};

}  // namespace

Level loop_step(const LevelView& coarse, std::span<const std::uint32_t> first_of_level,
                const Features& features,
                const SubdivideOptions& options, bool is_last) {
  Level finer = refine(coarse, is_last, options.progress,
                       [&](const EdgeSite& edge) { return smooth_edge_point(coarse, edge); });
  const SmoothVertices smooth(coarse, first_of_level);
  parallel_for(coarse.vertex_count(), kGrain,
               [&](IndexRange vertices) { smooth.place(vertices, finer.position); });
  const SharpStep sharp(coarse, features, options);
  parallel_for_each(features.edges().size(), kGrain,
                    [&](std::uint32_t i) { sharp.place_on(features.edges()[i], finer); });
  parallel_for_each(features.vertices().size(), kGrain,
                    [&](std::uint32_t i) { sharp.place(features.vertices()[i], finer); });
  return finer;
}

}  // namespace mesher
