#pragma once

#include <cstdint>
#include <vector>

#include "engine/mesh/build/soup.h"

namespace mesher {

/// Returns the faces with four or more corners that repeat an earlier face: the same corners in the
/// same cyclic order, in either direction. Two-sided quads are common; cut along two different
/// diagonals, they would become a closed pillow. (Triangles are compared in edge matching.) In
/// increasing order. O(n log n) in the number of such faces, O(corners). Internal to triangulation.
std::vector<std::uint32_t> duplicate_polygons(const Soup& soup);

}  // namespace mesher
