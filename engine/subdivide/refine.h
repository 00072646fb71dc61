#pragma once

#include <array>
#include <vector>

#include "engine/core/parallel.h"
#include "engine/core/progress.h"
#include "engine/subdivide/level.h"

namespace mesher::subdivide {

// The connectivity of splitting each face into four, which is the same for every scheme. There is
// one new vertex per edge. New vertices come after the old ones, in the order in which a walk over
// faces 0..F-1 and their edges ab, bc, ca first visits the edges.

/// The faces per work unit: their data stays in the cache.
inline constexpr std::size_t kFaceChunk = 2048;

/// An edge, seen from its lower half-edge.
struct EdgeSite {
  Halfedge h;
  Halfedge next;
  Halfedge prev;
  Halfedge twin;  ///< none on a boundary
};

/// Returns the next level of `coarse`. `place(EdgeSite)` returns the position of the new vertex on
/// an edge; it is called once per edge, from several threads. The positions of the old vertices are
/// not set. Outgoing half-edges are set for the new vertices only (see `write_outgoing`). With
/// `is_last` there are no twins and no outgoing half-edges. O(F). Throws Cancelled. Pre: the finer
/// half-edges have ids.
template <class Place>
Level refine(const LevelView& coarse, bool is_last, Progress* progress, const Place& place);

/// Returns the number of edges. O(F), parallel.
std::uint32_t count_edges(std::span<const Halfedge> twin);

/// Returns uninitialized arrays for the next level; with `is_last`, without twins and outgoing
/// half-edges.
Level unfilled_level(const LevelView& coarse, std::uint32_t edges, bool is_last);

/// The twelve half-edges of a face's children are stored four at a time: storing them one by one is
/// the bottleneck of a step.
using FourIndices = std::uint32_t __attribute__((vector_size(16), aligned(4), may_alias));

/// Writes the corners of a face's children, given its corners and the vertices on its edges ab, bc,
/// ca.
inline void write_children(const std::array<Vertex, 3>& corner, const std::array<Vertex, 3>& edge,
                           Vertex* child) {
  const auto [a, b, c] = corner;
  const auto [ab, bc, ca] = edge;
  auto* const to = reinterpret_cast<FourIndices*>(child);
  to[0] = FourIndices{a.index(), ab.index(), ca.index(), ab.index()};
  to[1] = FourIndices{b.index(), bc.index(), ca.index(), bc.index()};
  to[2] = FourIndices{c.index(), ab.index(), bc.index(), ca.index()};
}

/// Writes the twins in the children of `faces`.
void write_twins(const LevelView& coarse, IndexRange faces, Level& finer);
/// Writes the outgoing half-edges of the old vertices. O(V), parallel.
void write_outgoing(const LevelView& coarse, Level& finer);

namespace refine_detail {

/// Times of placing the new vertices, and of writing the faces: medians of three schemes.
inline constexpr double kRefineWeights[] = {0.91, 0.09};

/// Returns, for each chunk of half-edges, the number of edges that begin before it, and finally the
/// total number of edges.
std::vector<std::uint32_t> first_edges(std::span<const Halfedge> twin, std::size_t chunk);

void write_faces(const LevelView& coarse, IndexRange faces, std::span<const Vertex> vertex_on,
                 Level& finer);

/// Creates the new vertices on the edges that begin in `faces`. They are numbered from `next` on
/// and stored in `vertex_on` under the edge's lower half-edge.
template <class Place>
void write_edges(const LevelView& coarse, IndexRange faces, std::uint32_t next,
                 std::span<Vertex> vertex_on, Level& finer, const Place& place) {
  const auto number = [&](std::uint32_t h, std::uint32_t next_h, std::uint32_t prev_h) {
    const Halfedge twin = coarse.twin[h];
    if (twin.index() < h) return;  // none is the highest index
    vertex_on[h] = Vertex(next);
    if (!finer.outgoing.empty()) finer.outgoing[next] = second_half(Halfedge(h));
    place(EdgeSite{Halfedge(h), Halfedge(next_h), Halfedge(prev_h), twin})
        .store(finer.position[next]);
    ++next;
  };
  for (auto f = static_cast<std::uint32_t>(faces.begin); f < faces.end; ++f) {
    number(3 * f, 3 * f + 1, 3 * f + 2);
    number(3 * f + 1, 3 * f + 2, 3 * f);
    number(3 * f + 2, 3 * f, 3 * f + 1);
  }
}

}  // namespace refine_detail

template <class Place>
Level refine(const LevelView& coarse, bool is_last, Progress* progress, const Place& place) {
  namespace detail = refine_detail;
  const std::size_t faces = coarse.face_count();
  const std::uint32_t old = coarse.vertex_count();
  Stages stages(progress, detail::kRefineWeights);
  stages.next();
  const std::vector<std::uint32_t> first = detail::first_edges(coarse.twin, 3 * kFaceChunk);
  Level finer = unfilled_level(coarse, first.back(), is_last);
  Array<Vertex> vertex_on(coarse.origin.size());
  parallel_chunks(faces, kFaceChunk, progress, [&](std::size_t chunk, IndexRange range) {
    detail::write_edges(coarse, range, old + first[chunk], vertex_on, finer, place);
  });
  stages.next();
  parallel_chunks(faces, kFaceChunk, progress, [&](std::size_t, IndexRange range) {
    detail::write_faces(coarse, range, vertex_on, finer);
    if (!is_last) write_twins(coarse, range, finer);
  });
  return finer;
}

}  // namespace mesher::subdivide
