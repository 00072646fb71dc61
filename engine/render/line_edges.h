#pragma once

#include <span>
#include <vector>

#include "engine/mesh/change_log.h"
#include "engine/mesh/mesh.h"

namespace mesher::render {

/// An edge drawn as a line of its own, in the GPU's layout.
struct Line {
  Halfedge halfedge;    ///< the lower of the edge's two
  float weight = 1.0F;  ///< fraction of its list's style: 1 is full, less is thinner and paler
  friend bool operator==(const Line&, const Line&) = default;
};
static_assert(sizeof(Line) == 8);

/// Width of a crease of weight 1, in pixels of a window of medium height.
inline constexpr float kCreaseWidth = 3.0F;

/// Returns the weight of a crease of that sharpness: 1 if infinite, falling continuously to 0 if
/// smooth. A sharpness of 10 still differs from infinite.
float line_weight(float sharpness);

/// Edges drawn as lines of their own, sorted by half-edge.
struct LineEdges {
  std::vector<Line> creases;     ///< weighted by sharpness
  std::vector<Line> boundaries;  ///< weight 1

  friend bool operator==(const LineEdges&, const LineEdges&) = default;
};

/// Returns the line edges of a mesh. O(F), parallel.
LineEdges find_line_edges(const Mesh& mesh);

/// Updates `edges` where half-edges changed class, sharpness or twin, and drops edges that the mesh
/// no longer has. Pre: `changed` is sorted, disjoint, and within the mesh. O(edges + changed
/// half-edges).
void update_line_edges(const Mesh& mesh, std::span<const ChangedRange> changed, LineEdges& edges);

}  // namespace mesher::render
