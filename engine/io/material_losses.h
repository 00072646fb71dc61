#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "engine/mesh/attributes.h"
#include "engine/mesh/material.h"

namespace mesher::io {

/// How a format stores materials.
enum class HoldsMaterials {
  nothing,
  color_textures,  ///< nothing but base color textures, in files beside
  as_mtl,          ///< in a file beside, with the images
  as_gltf,         ///< in the file, with the images
};

/// Returns whether a format stores materials, and not only their color textures.
constexpr bool holds_look(HoldsMaterials holds) {
  return holds == HoldsMaterials::as_mtl || holds == HoldsMaterials::as_gltf;
}

/// Returns the number of sets of texture coordinates: TEXCOORD_0, TEXCOORD_1, ... without gaps.
std::uint32_t count_uv_sets(const Attributes& attributes);

/// Returns what such a format does not hold of materials that it holds otherwise: "bump map of 2
/// materials", "texture a.tga (glTF has no such images)". O(statements). `uv_sets` is the number of
/// sets of texture coordinates.
std::vector<std::string> material_losses(const Materials& materials, HoldsMaterials holds,
                                         std::uint32_t uv_sets);

}  // namespace mesher::io
