#include "engine/subdivide/smooth_step.h"

#include <algorithm>

#include "engine/core/parallel.h"
#include "engine/core/prefetch.h"
#include "engine/mesh/circulators.h"
#include "engine/subdivide/refine.h"
#include "engine/subdivide/ring_masks.h"

namespace mesher::subdivide {
namespace {

/// Times of refining, and of moving the old vertices, measured with 0.1 to 5 million faces.
constexpr double kGatherWeights[] = {0.77, 0.23};

constexpr std::size_t kVertexChunk = 8192;
// From this valence on, a sum of floats may have a relative error above 1e-6.
constexpr std::uint32_t kSmoothHubValence = 65;

/// Returns one face's contribution to the new vertex on one of its edges; two faces contribute.
inline Point edge_share(Point start, Point end, Point opposite) {
  return static_cast<float>(kLoopEdgeEnd / 2.0) * (start + end) +
         static_cast<float>(kLoopEdgeOpposite) * opposite;
}

/// Prefetches the random accesses of the faces a little further on: the ids of the vertices on
/// edges that began earlier, then their positions.
inline void look_ahead(const LevelView& coarse, const Level& finer, std::uint32_t f) {
  constexpr std::uint32_t kFar = 16;
  constexpr std::uint32_t kNear = 8;
  const std::uint32_t last = coarse.face_count() - 1;
  const std::uint32_t far = 3 * std::min(f + kFar, last);
  const std::uint32_t near = 3 * std::min(f + kNear, last);
  for (std::uint32_t k = 0; k < 3; ++k) {
    const Halfedge far_twin = coarse.twin[far + k];
    const Halfedge near_twin = coarse.twin[near + k];
    prefetch(&coarse.position[coarse.origin[far + k].index()]);
    if (far_twin.index() < 3 * f) {
      prefetch(&finer.origin[second_half(far_twin).index()]);
    }
    if (near_twin.index() < 3 * f) {
      prefetch(&finer.position[edge_vertex(finer, near_twin).index()]);
    }
  }
}

/// Adds the contributions of a run of faces, writes their children, and numbers the edges that
/// begin in them from `next` on. The only data read across an edge is the id of its vertex.
void sweep(const LevelView& coarse, IndexRange faces, Level& finer, Array<Point>& rings,
           std::uint32_t& next) {
  // Plain pointers, because the compiler would reload those of the arrays after every store.
  const LevelView level = coarse;
  Vertex* const origin = finer.origin.data();
  glm::vec3* const position = finer.position.data();
  Halfedge* const outgoing = finer.outgoing.empty() ? nullptr : finer.outgoing.data();
  Point* const ring = rings.data();
  const auto add_to_edge = [&](std::uint32_t h, Point share) {
    const Halfedge twin = level.twin[h];
    if (twin.index() < h) {  // none is the highest index
      const Vertex v = origin[second_half(twin).index()];
      (Point(position[v.index()]) + share).store(position[v.index()]);
      return v;
    }
    const Vertex v(next++);
    share.store(position[v.index()]);
    if (outgoing != nullptr) outgoing[v.index()] = second_half(Halfedge(h));
    return v;
  };
  const auto end = static_cast<std::uint32_t>(faces.end);
  for (auto f = static_cast<std::uint32_t>(faces.begin); f < end; ++f) {
    look_ahead(level, finer, f);
    const Vertex a = level.origin[3 * f];
    const Vertex b = level.origin[3 * f + 1];
    const Vertex c = level.origin[3 * f + 2];
    const Point at_a = level.point(a);
    const Point at_b = level.point(b);
    const Point at_c = level.point(c);
    ring[a.index()] = ring[a.index()] + at_b;
    ring[b.index()] = ring[b.index()] + at_c;
    ring[c.index()] = ring[c.index()] + at_a;
    const Vertex ab = add_to_edge(3 * f, edge_share(at_a, at_b, at_c));
    const Vertex bc = add_to_edge(3 * f + 1, edge_share(at_b, at_c, at_a));
    const Vertex ca = add_to_edge(3 * f + 2, edge_share(at_c, at_a, at_b));
    write_children({a, b, c}, {ab, bc, ca}, origin + std::size_t{12} * f);
  }
}

/// Moves the old vertices, given the sum of their neighbors.
class VertexMasks {
 public:
  explicit VertexMasks(const Rings& rings) : rings_(rings) {}
  Point apply(std::uint32_t v, Point own, Point ring) const {
    const RingMasks::Weights weights =
        v < rings_.base_vertices() ? masks_(rings_.base_valence(v)) : regular_;
    return weights.own * own + weights.each * ring;
  }

 private:
  const Rings& rings_;
  RingMasks masks_{loop_vertex_mask};
  RingMasks::Weights regular_ = masks_(6);
};

Level swept(const LevelView& coarse, const Rings& rings, bool is_last, Progress* progress) {
  Level finer = unfilled_level(coarse, count_edges(coarse.twin), is_last);
  Array<Point> ring(coarse.vertex_count(), Point());
  const std::size_t faces = coarse.face_count();
  std::uint32_t next = coarse.vertex_count();
  ordered_chunks(faces, kFaceChunk, progress, [&](IndexRange chunk) {
    sweep(coarse, chunk, finer, ring, next);
    if (!is_last) write_twins(coarse, chunk, finer);
  });
  const VertexMasks masks(rings);
  for (std::uint32_t v = 0; v < coarse.vertex_count(); ++v)
    masks.apply(v, coarse.point(Vertex(v)), ring[v]).store(finer.position[v]);
  return finer;
}

Point gathered_edge(const LevelView& level, const EdgeSite& edge) {
  const Point start = level.from(edge.h);
  const Point end = level.from(edge.next);
  const Point share = edge_share(start, end, level.from(edge.prev));
  if (!edge.twin.is_valid()) return share;
  return share + edge_share(end, start, level.from(Mesh::prev(edge.twin)));
}

Level gathered(const LevelView& coarse, const Rings& rings, bool is_last, Progress* progress) {
  Stages stages(progress, kGatherWeights);
  stages.next();
  Level finer = refine(coarse, is_last, progress,
                       [&](const EdgeSite& edge) { return gathered_edge(coarse, edge); });
  const VertexMasks masks(rings);
  const auto place = [&](std::uint32_t v) {
    Point ring;
    const Halfedge start = coarse.outgoing[v];
    if (start.is_valid() && coarse.twin[start.index()].is_valid()) {
      rings.for_each_spoke(coarse, Vertex(v), [&](Halfedge h) { ring = ring + coarse.to(h); });
    }
    masks.apply(v, coarse.point(Vertex(v)), ring).store(finer.position[v]);
  };
  stages.next();
  parallel_chunks(coarse.vertex_count(), kVertexChunk, progress,
                  [&](std::size_t, IndexRange vertices) {
                    for (std::size_t v = vertices.begin; v < vertices.end; ++v)
                      place(static_cast<std::uint32_t>(v));
                  });
  return finer;
}

/// Recomputes the vertices of high valence in double: there are few.
void place_hubs(const LevelView& coarse, const Rings& rings, Level& finer) {
  for (std::uint32_t v = 0; v < rings.base_vertices(); ++v) {
    const std::uint32_t valence = rings.base_valence(v);
    if (valence < kSmoothHubValence) continue;
    glm::dvec3 ring(0.0);
    Circulator at(coarse, coarse.outgoing[v]);
    do {
      ring += glm::dvec3(coarse.position[coarse.origin[Mesh::next(*at).index()].index()]);
    } while (at.advance());
    const RingMask mask = loop_vertex_mask(valence);
    finer.position[v] = mask.own * glm::dvec3(coarse.position[v]) + mask.each * ring;
  }
}

}  // namespace

Level smooth_step(const LevelView& coarse, const Rings& rings, bool is_last, Progress* progress) {
  Level finer = rings.lists_spokes() ? gathered(coarse, rings, is_last, progress)
                                     : swept(coarse, rings, is_last, progress);
  check_cancelled(progress);
  place_hubs(coarse, rings, finer);
  if (!is_last) write_outgoing(coarse, finer);
  return finer;
}

}  // namespace mesher::subdivide
