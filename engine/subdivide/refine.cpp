#include "engine/subdivide/refine.h"

#include <algorithm>

namespace mesher::subdivide {
namespace {

constexpr std::size_t kRefineGrain = 1U << 16U;

std::uint32_t count_first(std::span<const Halfedge> twin, IndexRange range) {
  std::uint32_t count = 0;
  for (std::size_t h = range.begin; h < range.end; ++h)
    count += twin[h].index() > h ? 1U : 0U;
  return count;
}

}  // namespace

LevelView view_of(const Mesh& mesh) {
  return {mesh.positions(), mesh.origins(), mesh.twins(), mesh.outgoings()};
}

std::uint32_t count_edges(std::span<const Halfedge> twin) {
  return parallel_sum<std::uint32_t>(twin.size(), kRefineGrain,
                                     [&](IndexRange range) { return count_first(twin, range); });
}

Level unfilled_level(const LevelView& coarse, std::uint32_t edges, bool is_last) {
  const std::size_t halfedges = 4 * coarse.origin.size();
  Level level;
  level.position.resize(coarse.position.size() + edges);
  level.origin.resize(halfedges);
  if (!is_last) {
    level.twin.resize(halfedges);
    level.outgoing.resize(level.position.size());
  }
  return level;
}

namespace refine_detail {

std::vector<std::uint32_t> first_edges(std::span<const Halfedge> twin, std::size_t chunk) {
  std::vector<std::uint32_t> first(chunk_count(twin.size(), chunk) + 1, 0);
  parallel_chunks(twin.size(), chunk, [&](std::size_t i, IndexRange range) {
    first[i + 1] = count_first(twin, range);
  });
  for (std::size_t i = 1; i < first.size(); ++i)
    first[i] += first[i - 1];
  return first;
}

void write_faces(const LevelView& coarse, IndexRange faces, std::span<const Vertex> vertex_on,
                 Level& finer) {
  const auto edge_vertex_of = [&](std::size_t h) {
    return vertex_on[std::min<std::size_t>(h, coarse.twin[h].index())];  // none is the highest
  };
  for (std::size_t f = faces.begin; f < faces.end; ++f) {
    const std::size_t h = 3 * f;
    write_children({coarse.origin[h], coarse.origin[h + 1], coarse.origin[h + 2]},
                   {edge_vertex_of(h), edge_vertex_of(h + 1), edge_vertex_of(h + 2)},
                   &finer.origin[12 * f]);
  }
}

}  // namespace refine_detail

void write_twins(const LevelView& coarse, IndexRange faces, Level& finer) {
  const auto first = [](Halfedge t) { return t.is_valid() ? first_half(t).index() : kNone; };
  const auto second = [](Halfedge t) { return t.is_valid() ? second_half(t).index() : kNone; };
  for (std::size_t f = faces.begin; f < faces.end; ++f) {
    const Halfedge ab = coarse.twin[3 * f];
    const Halfedge bc = coarse.twin[3 * f + 1];
    const Halfedge ca = coarse.twin[3 * f + 2];
    const auto base = static_cast<std::uint32_t>(12 * f);
    // Each outer child shares one edge with the middle child, whose corners are the last three.
    auto* const to = reinterpret_cast<FourIndices*>(&finer.twin[12 * f]);
    to[0] = FourIndices{second(ab), base + 11, first(ca), first(ab)};
    to[1] = FourIndices{second(bc), base + 9, base + 10, first(bc)};
    to[2] = FourIndices{second(ca), base + 5, base + 6, base + 1};
  }
}

void write_outgoing(const LevelView& coarse, Level& finer) {
  parallel_for_each(coarse.vertex_count(), kRefineGrain, [&](std::uint32_t v) {
    const Halfedge h = coarse.outgoing[v];
    finer.outgoing[v] = h.is_valid() ? first_half(h) : h;
  });
}

}  // namespace mesher::subdivide
