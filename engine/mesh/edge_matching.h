#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "engine/core/array.h"
#include "engine/mesh/ids.h"

namespace mesher {

/// The half-edges of triangles matched by undirected edge. Internal to building.
struct EdgeMatching {
  /// The other half-edge of each edge that has exactly two, whichever way they run; none otherwise.
  Array<Halfedge> twin;
  /// Edges whose two half-edges run the same way: their faces disagree in orientation.
  std::uint64_t disagreeing_edges = 0;
  /// Edges of three and more faces: group i holds half-edges
  /// crowded[crowd_start[i]] .. crowded[crowd_start[i+1]-1], by increasing index.
  std::vector<std::uint32_t> crowded;
  std::vector<std::size_t> crowd_start{0};
  /// Faces with the same three vertices as an earlier one, in increasing order.
  std::vector<std::uint32_t> duplicate_faces;

  std::size_t crowd_count() const { return crowd_start.size() - 1; }
  std::span<const std::uint32_t> crowd(std::size_t i) const {
    return {crowded.data() + crowd_start[i], crowd_start[i + 1] - crowd_start[i]};
  }
};

/// Chains the half-edges by the lower vertex of their edge, in the memory that the twins will have.
/// Those of a short chain are compared with all others at once; a long one, or one with crowds or
/// duplicates, is sorted by the other vertex: O(F + V) where valences are bounded, O(k log k) for a
/// chain of k, and no memory but 4 bytes a vertex. The chains are matched in parallel; the result
/// does not depend on the number of threads. `origin` holds 3F vertices below `vertex_count`; no
/// face uses one twice.
EdgeMatching match_edges(const Array<Vertex>& origin, std::uint32_t vertex_count);

}  // namespace mesher
