#pragma once

#include <algorithm>
#include <vector>

#include "engine/core/parallel.h"
#include "engine/core/progress.h"
#include "engine/subdivide/level.h"

namespace mesher {

/// An edge as its lower half-edge sees it.
struct EdgeSite {
  Halfedge h;
  Halfedge next;
  Halfedge prev;
  Halfedge twin;  ///< none on a boundary
};

/// Splits the faces of `coarse` in four and numbers the new vertices: one an edge, after the old
/// ones, in the order met when walking faces 0..F-1 and their edges ab, bc, ca. `place(EdgeSite)`
/// says where the new vertex on an edge goes, asked once an edge from several threads. The places of
/// the old vertices are left open. With `is_last`, no twins and no outgoing half-edges are made.
/// O(F).
/// Pre: the finer half-edges have ids.
template <class Place>
Level refine(const LevelView& coarse, bool is_last, Progress* progress, Place place);

/// Number of edges. O(F), parallel.
std::uint64_t count_edges(std::span<const Halfedge> twin);

namespace refine_detail {

/// Small enough that a chunk is still in the cache when its faces are made after its edges.
inline constexpr std::size_t kChunk = 2048;

/// For each chunk of half-edges the number of edges that begin before it, and the number of all.
std::vector<std::uint32_t> first_edges(std::span<const Halfedge> twin, std::size_t chunk);

void write_faces(const LevelView& coarse, IndexRange faces, Level& finer);
void write_twins(const LevelView& coarse, IndexRange faces, Level& finer);
void write_outgoing(const LevelView& coarse, IndexRange vertices, Level& finer);

/// The new vertices on the edges that begin in `faces`: their numbers from `next` on.
template <class Place>
void write_edges(const LevelView& coarse, IndexRange faces, std::uint32_t next, bool is_last,
                 Level& finer, const Place& place) {
  const Halfedge* const twins = coarse.twin.data();
  Vertex* const origin = finer.origin.data();
  glm::vec3* const position = finer.position.data();
  Halfedge* const outgoing = is_last ? nullptr : finer.outgoing.data();
  const auto number = [&](std::uint32_t h, std::uint32_t next_h, std::uint32_t prev_h) {
    const Halfedge twin = twins[h];
    if (twin.index() < h) return;  // none is the highest of all
    const Halfedge half = second_half(Halfedge(h));
    origin[half.index()] = Vertex(next);
    if (outgoing != nullptr) outgoing[next] = half;
    place({Halfedge(h), Halfedge(next_h), Halfedge(prev_h), twin}).store(position[next]);
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
Level refine(const LevelView& coarse, bool is_last, Progress* progress, Place place) {
  namespace detail = refine_detail;
  const std::size_t faces = coarse.face_count();
  const std::uint32_t old = coarse.vertex_count();
  const std::vector<std::uint32_t> first = detail::first_edges(coarse.twin, 3 * detail::kChunk);
  Level finer;
  finer.position.resize(std::size_t{old} + first.back());
  finer.origin.resize(12 * faces);
  if (!is_last) {
    finer.twin.resize(12 * faces);
    finer.outgoing.resize(finer.position.size());
  }
  const auto edges_of = [&](std::size_t chunk, IndexRange range) {
    detail::write_edges(coarse, range, old + first[chunk], is_last, finer, place);
  };
  const auto faces_of = [&](std::size_t, IndexRange range) {
    detail::write_faces(coarse, range, finer);
    if (!is_last) detail::write_twins(coarse, range, finer);
  };
  if (thread_count() == 1) {
    // A face asks only for edges that begin in it or before it: both can be done while its chunk
    // is in the cache.
    for (std::size_t begin = 0, chunk = 0; begin < faces; begin += detail::kChunk, ++chunk) {
      const IndexRange range{begin, std::min(begin + detail::kChunk, faces)};
      if (chunk % 64 == 0) report(progress, static_cast<float>(begin) / static_cast<float>(faces));
      edges_of(chunk, range);
      faces_of(chunk, range);
    }
  } else {
    parallel_chunks(faces, detail::kChunk, edges_of);
    report(progress, 0.5F);
    parallel_chunks(faces, detail::kChunk, faces_of);
  }
  if (!is_last) {
    parallel_for(old, 4 * detail::kChunk,
                 [&](IndexRange range) { detail::write_outgoing(coarse, range, finer); });
  }
  return finer;
}

}  // namespace mesher
