#include "engine/subdivide/refine.h"

#include <atomic>

namespace mesher {
namespace {

constexpr std::size_t kGrain = 1U << 16U;
constexpr auto kRelaxed = std::memory_order_relaxed;

/// The number of an edge's vertex, which the threads of both its faces look at: one may write there
/// what is written there already.
std::atomic_ref<Vertex> shared(Vertex& v) {
  return std::atomic_ref<Vertex>(v);
}

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

std::uint64_t count_edges(std::span<const Halfedge> twin) {
  return parallel_sum<std::uint64_t>(
      twin.size(), kGrain, [&](IndexRange range) { return count_first(twin, range); });
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

void write_faces(const LevelView& coarse, IndexRange faces, Level& finer) {
  const auto edge_vertex_of = [&](std::uint32_t i) {
    const Halfedge h(i);
    const Halfedge t = coarse.twin[i];
    return shared(finer.origin[second_half(t < h ? t : h).index()]).load(kRelaxed);
  };
  for (std::size_t f = faces.begin; f < faces.end; ++f) {
    const auto h = static_cast<std::uint32_t>(3 * f);
    const Vertex ab = edge_vertex_of(h);
    const Vertex bc = edge_vertex_of(h + 1);
    const Vertex ca = edge_vertex_of(h + 2);
    Vertex* child = &finer.origin[12 * f];
    child[0] = coarse.origin[h];
    child[1] = ab;
    shared(child[2]).store(ca, kRelaxed);
    shared(child[3]).store(ab, kRelaxed);
    child[4] = coarse.origin[h + 1];
    child[5] = bc;
    child[6] = ca;
    shared(child[7]).store(bc, kRelaxed);
    child[8] = coarse.origin[h + 2];
    child[9] = ab;
    child[10] = bc;
    child[11] = ca;
  }
}

void write_twins(const LevelView& coarse, IndexRange faces, Level& finer) {
  for (std::size_t f = faces.begin; f < faces.end; ++f) {
    Halfedge* child = &finer.twin[12 * f];
    const auto base = static_cast<std::uint32_t>(12 * f);
    for (std::uint32_t k = 0; k < 3; ++k) {
      const auto h = static_cast<std::uint32_t>(3 * f + k);
      const Halfedge t = coarse.twin[h];
      finer.twin[first_half(Halfedge(h)).index()] = t.is_valid() ? second_half(t) : t;
      finer.twin[second_half(Halfedge(h)).index()] = t.is_valid() ? first_half(t) : t;
    }
    // Each outer child shares one edge with the middle one.
    child[1] = Halfedge(base + 11);
    child[5] = Halfedge(base + 9);
    child[6] = Halfedge(base + 10);
    child[9] = Halfedge(base + 5);
    child[10] = Halfedge(base + 6);
    child[11] = Halfedge(base + 1);
  }
}

void write_outgoing(const LevelView& coarse, IndexRange vertices, Level& finer) {
  for (std::size_t v = vertices.begin; v < vertices.end; ++v) {
    const Halfedge h = coarse.outgoing[v];
    finer.outgoing[v] = h.is_valid() ? first_half(h) : h;
  }
}

}  // namespace refine_detail
}  // namespace mesher
