#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "engine/mesh/mesh.h"

namespace mesher::app {

/// The mode in which clicks select edges, and the selection.
struct CreaseMode {
  bool is_on = false;
  std::vector<Edge> selected;     ///< ascending
  Edge hovered;                   ///< under the cursor; none: no edge is
  float finite_sharpness = 2.0F;  ///< for edges that stop being infinitely sharp
  float tag_angle_deg = 40.0F;    ///< of the command that marks creases by angle
  std::uint64_t drags = 0;        ///< number of the last drag of the sharpness slider

  /// Clears the selection. Call when the edges of the mesh have changed.
  void forget_edges() {
    selected.clear();
    hovered = {};
  }
  /// The selected edges off the boundary. O(selected edges).
  std::vector<Edge> selected_inner_edges(const Mesh& mesh) const;
};

/// Those of `edges` that are off the boundary. O(edges).
std::vector<Edge> inner_edges(const Mesh& mesh, std::span<const Edge> edges);

/// The sharpness of the selected edges. Boundary edges are always sharp and do not count.
struct SelectedSharpness {
  std::uint32_t edges = 0;  ///< number of selected edges off the boundary
  float least = 0.0F;
  float most = 0.0F;
  bool is_mixed() const { return least != most; }
};
/// O(selected edges).
SelectedSharpness selected_sharpness(const Mesh& mesh, const CreaseMode& creases);

}  // namespace mesher::app
