#pragma once

#include "engine/mesh/mesh.h"

namespace mesher::app {

/// The root mean square distance of about 4,096 points of `input` (centers of faces, by area) from
/// the surface of `result`, in model units; 0 where one of them has no faces. O(F log F) of the
/// result, O(F) of the input.
double distance_from_input(const Mesh& input, const Mesh& result);

}  // namespace mesher::app
