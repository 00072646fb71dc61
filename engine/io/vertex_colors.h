#pragma once

#include <glm/gtc/type_precision.hpp>

#include "engine/core/array.h"
#include "engine/mesh/attributes.h"
#include "engine/mesh/mesh.h"

namespace mesher {

/// One colour a vertex, where all corners at each vertex agree (an isolated vertex is white); else,
/// or where there are no colours, empty. For formats that know no corners. O(F).
Array<glm::u8vec4> vertex_colors(const Mesh& mesh, const Attributes& attributes);

}  // namespace mesher
