#pragma once

#include <cstdint>
#include <vector>

#include "engine/mesh/soup.h"

namespace mesher {

/// Faces of four and more corners that run through the same corners, in the same cyclic order
/// either way round, as an earlier face: two-sided quads are common, and cut by two different
/// diagonals they would become a closed pillow. (Triangles are compared when their edges are
/// matched.) In increasing order. O(n log n) in the number of such faces, O(corners). Internal to
/// triangulation.
std::vector<std::uint32_t> duplicate_polygons(const Soup& soup);

}  // namespace mesher
