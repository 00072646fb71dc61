#pragma once

#include <span>
#include <vector>

#include "engine/mesh/change_log.h"
#include "engine/mesh/mesh.h"

namespace mesher::render {

/// The edges that are drawn as lines of their own, one half-edge each (the lower of two), sorted.
struct LineEdges {
  std::vector<Halfedge> creases;
  std::vector<Halfedge> boundaries;

  friend bool operator==(const LineEdges&, const LineEdges&) = default;
};

/// O(F), parallel.
LineEdges find_line_edges(const Mesh& mesh);

/// Brings `edges` up to date where half-edges changed class or twin, and drops those that the mesh
/// no longer has. `changed` is sorted, disjoint, and within the mesh. O(edges + changed
/// half-edges).
void update_line_edges(const Mesh& mesh, std::span<const ChangedRange> changed, LineEdges& edges);

}  // namespace mesher::render
