#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "engine/core/array.h"
#include "engine/core/progress.h"
#include "engine/mesh/ids.h"

namespace mesher {

/// The half-edges of triangles matched by undirected edge. A *crowd* is an edge of three or more
/// faces. Internal to building.
struct EdgeMatching {
  /// For each half-edge of an edge with exactly two half-edges, the other one, in either direction;
  /// none for any other edge.
  Array<Halfedge> twin;
  /// The number of edges whose two half-edges run in the same direction: their faces disagree in
  /// orientation.
  std::uint64_t disagreeing_edges = 0;
  /// The half-edges of crowds: crowd i is crowded[crowd_start[i]] .. crowded[crowd_start[i+1]-1],
  /// by increasing index.
  std::vector<std::uint32_t> crowded;
  std::vector<std::size_t> crowd_start{0};
  /// The faces with the same three vertices as another face, in increasing order.
  std::vector<std::uint32_t> coincident_faces;

  std::size_t crowd_count() const { return crowd_start.size() - 1; }
  std::span<const std::uint32_t> crowd(std::size_t i) const {
    return {crowded.data() + crowd_start[i], crowd_start[i + 1] - crowd_start[i]};
  }
};

/// Returns the half-edges matched by edge. Half-edges are chained by the lower vertex of their
/// edge, in the memory of the twins. In a short chain, each half-edge is compared with all others
/// at once. A long chain, or one with crowds or duplicates, is sorted by the other vertex. If there
/// are many half-edges per vertex, as in dense polygon soup, two counting sorts replace the chains.
///
/// O(F + V) if valences are bounded, O(k log k) for a chain of k; scratch memory of 4 bytes per
/// vertex, and 48 per face of dense soup. Chains are matched in parallel; the result does not
/// depend on the number of threads. Pre: `origin` holds 3F vertices below `vertex_count`; no face
/// uses a vertex twice. Throws Cancelled.
EdgeMatching match_edges(const Array<Vertex>& origin, std::uint32_t vertex_count,
                         Progress* progress = nullptr);

}  // namespace mesher
