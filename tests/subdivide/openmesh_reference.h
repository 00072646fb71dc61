#pragma once

#include "tests/subdivide/plain_mesh.h"

namespace mesher::test {

/// One level of butterfly subdivision by OpenMesh, in our numbering. Only positions and triangles.
PlainMesh openmesh_butterfly(const PlainMesh& mesh);

}  // namespace mesher::test
