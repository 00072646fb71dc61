#pragma once

#include "engine/mesh/mesh.h"

namespace mesher::simplify {

/// Returns the power of two that scales the mesh so that squares and products of its areas stay far
/// from the limits of float; 1 if they do anyway. Scaling by it is lossless. Ignores isolated
/// vertices. The costs of a run are those of the scaled mesh. O(V).
float handy_scale(const Mesh& mesh);

}  // namespace mesher::simplify
