#pragma once

#include "tests/subdivide/plain_mesh.h"

namespace mesher::test {

/// Refines by one level of butterfly (N. Dyn et al., 1990, modified by D. Zorin et al., 1996). Old
/// vertices do not move. Handles only positions and triangles; sharpness has no effect and is not
/// carried over.
PlainMesh refine_butterfly(const PlainMesh& mesh);

/// Refines by one level that inserts new vertices at the midpoints of edges.
PlainMesh refine_midpoint(const PlainMesh& mesh);

}  // namespace mesher::test
