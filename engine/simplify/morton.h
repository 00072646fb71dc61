#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <span>

#include "engine/core/array.h"
#include "engine/core/progress.h"
#include "engine/mesh/ids.h"

namespace mesher::simplify {

/// The grid whose cells are ordered: 2^bits cells per side (at most 2^10). The bounding box of the
/// vertices takes up half of each side; `shift` (0 to 1) moves it within the grid, so that the
/// curve jumps at other vertices.
struct MortonGrid {
  std::uint32_t bits = 10;
  float shift = 0.0F;
};

/// Returns the vertices sorted along a Z-order curve through their bounding box (G. Morton, 1966),
/// so that neighbors on the surface are mostly neighbors in the order. Stable. O(n). Throws
/// Cancelled; does not report.
Array<Vertex> morton_order(std::span<const glm::vec3> positions, std::span<const Vertex> vertices,
                           const MortonGrid& grid, const Progress* progress = nullptr);

}  // namespace mesher::simplify
