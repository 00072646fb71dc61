#pragma once

#include "engine/mesh/mesh.h"

namespace mesher {

/// Makes `outgoing` of positions, origins and twins: the half-edge without twin where there is one
/// (invariant 9), otherwise the lowest out of the vertex; none where no face uses it. O(V + F).
void fill_outgoing(MeshArrays& arrays);

}  // namespace mesher
