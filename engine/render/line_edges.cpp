#include "engine/render/line_edges.h"

#include <algorithm>

#include "engine/core/parallel.h"

namespace mesher::render {
namespace {

void append(const Mesh& mesh, IndexRange range, LineEdges& edges) {
  for (std::size_t i = range.begin; i < range.end; ++i) {
    const Halfedge h(static_cast<std::uint32_t>(i));
    const EdgeClass edge_class = mesh.edge_class(h);
    if (edge_class == EdgeClass::ordinary || Mesh::halfedge(mesh.edge(h)) != h) continue;
    if (edge_class == EdgeClass::crease) {
      edges.creases.push_back({h, line_weight(mesh.sharpness(h))});
    } else {
      edges.boundaries.push_back({h, 1.0F});
    }
  }
}

void append(const std::vector<Line>& from, std::vector<Line>& to) {
  to.insert(to.end(), from.begin(), from.end());
}

/// Returns `sorted` up to `count`, with the lines in `changed` replaced by `fresh` (whose lines are
/// all in `changed`).
std::vector<Line> replace(const std::vector<Line>& sorted, std::uint32_t count,
                          std::span<const ChangedRange> changed, const std::vector<Line>& fresh) {
  std::vector<Line> kept;
  auto range = changed.begin();
  for (const Line& line : sorted) {
    const std::uint32_t h = line.halfedge.index();
    if (h >= count) break;
    while (range != changed.end() && range->end <= h)
      ++range;
    if (range == changed.end() || h < range->begin) kept.push_back(line);
  }
  std::vector<Line> result(kept.size() + fresh.size());
  std::merge(kept.begin(), kept.end(), fresh.begin(), fresh.end(), result.begin(),
             [](const Line& a, const Line& b) { return a.halfedge < b.halfedge; });
  return result;
}

}  // namespace

float line_weight(float sharpness) {
  // A crease of sharpness 2 has half the weight.
  constexpr float kHalf = 2.0F;
  return sharpness < kInfinitelySharp ? sharpness / (sharpness + kHalf) : 1.0F;
}

LineEdges find_line_edges(const Mesh& mesh) {
  constexpr std::size_t kChunk = 1U << 18;
  std::vector<LineEdges> parts(chunk_count(mesh.halfedge_count(), kChunk));
  parallel_chunks(mesh.halfedge_count(), kChunk,
                  [&](std::size_t chunk, IndexRange range) { append(mesh, range, parts[chunk]); });
  LineEdges all;
  for (const LineEdges& part : parts) {
    append(part.creases, all.creases);
    append(part.boundaries, all.boundaries);
  }
  return all;
}

void update_line_edges(const Mesh& mesh, std::span<const ChangedRange> changed, LineEdges& edges) {
  LineEdges fresh;
  for (const ChangedRange range : changed)
    append(mesh, {range.begin, range.end}, fresh);
  const std::uint32_t count = mesh.halfedge_count();
  edges.creases = replace(edges.creases, count, changed, fresh.creases);
  edges.boundaries = replace(edges.boundaries, count, changed, fresh.boundaries);
}

}  // namespace mesher::render
