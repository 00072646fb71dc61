#pragma once

#include <cstdint>

#include "engine/core/array.h"
#include "engine/mesh/mesh.h"

namespace mesher {

/// The faces sorted by where their centers lie along a Hilbert curve through the mesh's box: faces
/// that follow one another are near each other. Stable. O(F), the keys in parallel.
Array<std::uint32_t> faces_along_curve(const Mesh& mesh);

}  // namespace mesher
