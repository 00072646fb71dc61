#pragma once

#include <cstdint>

#include "engine/core/array.h"
#include "engine/mesh/mesh.h"

namespace mesher::analysis {

/// Returns the faces sorted by the position of their centers on a Hilbert curve through the mesh's
/// box: consecutive faces are near each other. Stable. O(F), with the keys computed in parallel.
Array<std::uint32_t> faces_along_curve(const Mesh& mesh);

}  // namespace mesher::analysis
