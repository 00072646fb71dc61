#pragma once

#include <cstdint>

#include "engine/core/array.h"
#include "engine/mesh/mesh.h"

namespace mesher::analysis {

/// Returns 1 for each vertex whose faces certainly form a graph over a plane: all of them face the
/// side to which their mean normal points, and they go around the vertex at most once. Such faces
/// meet in shared corners and sides only. Returns 0 for others, and for vertices
/// of more than 32 faces. O(F), parallel.
Array<std::uint8_t> find_graphs(const Mesh& mesh);

}  // namespace mesher::analysis
