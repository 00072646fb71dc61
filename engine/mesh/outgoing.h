#pragma once

#include "engine/core/progress.h"
#include "engine/mesh/mesh.h"

namespace mesher {

/// Fills `outgoing` from positions, origins and twins: the half-edge without twin if there is one
/// (invariant 9), otherwise the lowest half-edge out of the vertex; none if no face uses it. O(V +
/// F). Throws Cancelled.
void fill_outgoing(MeshArrays& arrays, Progress* progress = nullptr);

}  // namespace mesher
