#pragma once

#include "tests/subdivide/plain_mesh.h"

namespace mesher::test {

/// OpenMesh's opinion of one level of butterfly subdivision, in our numbering. Positions and
/// triangles only.
PlainMesh openmesh_butterfly(const PlainMesh& mesh);

}  // namespace mesher::test
