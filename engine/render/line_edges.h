#pragma once

#include <span>
#include <vector>

#include "engine/mesh/change_log.h"
#include "engine/mesh/mesh.h"

namespace mesher::render {

/// An edge that is drawn as a line of its own, as the GPU reads it.
struct Line {
  Halfedge halfedge;    ///< the lower of the edge's two
  float weight = 1.0F;  ///< of the look that its list has: 1 in full, less is thinner and paler
  friend bool operator==(const Line&, const Line&) = default;
};
static_assert(sizeof(Line) == 8);

/// How much of a crease's look an edge of that sharpness has: 1 where infinite, and continuously
/// less down to 0 where smooth. 10 steps still differ from for ever.
float line_weight(float sharpness);

/// The edges that are drawn as lines of their own, by half-edge.
struct LineEdges {
  std::vector<Line> creases;     ///< weight after their sharpness
  std::vector<Line> boundaries;  ///< weight 1

  friend bool operator==(const LineEdges&, const LineEdges&) = default;
};

/// O(F), parallel.
LineEdges find_line_edges(const Mesh& mesh);

/// Brings `edges` up to date where half-edges changed class, sharpness or twin, and drops those
/// that the mesh no longer has. `changed` is sorted, disjoint, and within the mesh. O(edges +
/// changed half-edges).
void update_line_edges(const Mesh& mesh, std::span<const ChangedRange> changed, LineEdges& edges);

}  // namespace mesher::render
