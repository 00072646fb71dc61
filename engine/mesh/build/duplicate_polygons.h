#pragma once

#include "engine/mesh/build/second_sides.h"
#include "engine/mesh/build/soup.h"

namespace mesher {

/// Returns the faces with four or more corners that have the corners of an earlier face, in the
/// same cyclic order and in either direction. Two-sided quads are common; cut along two different
/// diagonals, they would become a closed pillow. (Triangles are compared in edge matching.) Each
/// list in increasing order. O(n log n) in the number of such faces, O(corners). Internal to
/// triangulation.
CoincidentFaces coincident_polygons(const Soup& soup);

}  // namespace mesher
