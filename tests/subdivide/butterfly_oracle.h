#pragma once

#include "tests/subdivide/plain_mesh.h"

namespace mesher::test {

/// One level of N. Dyn et al., 1990, modified by D. Zorin et al., 1996: old vertices stay.
/// Positions and triangles only: sharpness has no part in it and is not carried.
PlainMesh refine_butterfly(const PlainMesh& mesh);

/// One level that puts new vertices in the middle of edges.
PlainMesh refine_midpoint(const PlainMesh& mesh);

}  // namespace mesher::test
