#pragma once

#include <cstdint>
#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <string>

#include "engine/mesh/material.h"

namespace mesher::io {

/// Returns whether glTF can hold an image: PNG, JPEG, and with an extension WebP, KTX2 and DDS.
bool can_embed(const EncodedImage& image);

/// Adds `materials`, `textures`, `samplers` and `images` to a glTF document, and the extensions
/// that they need to `extensionsUsed` and `extensionsRequired`.
///
/// Textures with coordinates of a set beyond the first `uv_sets` are left out: glTF forbids them.
/// `add_bytes` adds the bytes of an image to the buffer and returns the index of their view. Images
/// that cannot be embedded are left out with their textures. O(materials + images).
void add_gltf_materials(nlohmann::ordered_json& document, const Materials& materials,
                        std::uint32_t uv_sets,
                        const std::function<std::size_t(const std::string&)>& add_bytes);

}  // namespace mesher::io
