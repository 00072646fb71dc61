#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <span>

#include "engine/core/array.h"
#include "engine/mesh/ids.h"

namespace mesher {

/// The grid whose cells are put in order: 2^bits a side (at most 2^10), of which the vertices' box
/// takes up half; `shift` (0 to 1) moves the box within it, so that other vertices lie where the
/// curve jumps.
struct MortonGrid {
  std::uint32_t bits = 10;
  float shift = 0.0F;
};

/// Sorts vertices along a Z-shaped curve through their box (G. Morton, 1966), so that neighbors on
/// the surface are mostly neighbors in the order. Stable. O(n).
Array<Vertex> morton_order(std::span<const glm::vec3> positions, std::span<const Vertex> vertices,
                           const MortonGrid& grid);

}  // namespace mesher
