#pragma once

#include <string>
#include <vector>

#include "engine/mesh/material.h"

namespace mesher::io {

/// How a format stores materials.
enum class HoldsMaterials {
  nothing,
  as_mtl,   ///< in a file beside, with the images
  as_gltf,  ///< in the file, with the images
};

/// Returns what such a format does not hold of materials that it holds otherwise: "bump map of 2
/// materials", "texture a.tga (glTF has no such images)". O(statements).
std::vector<std::string> material_losses(const Materials& materials, HoldsMaterials holds);

}  // namespace mesher::io
