#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "engine/gpu/texture.h"
#include "engine/mesh/attributes.h"
#include "engine/mesh/material.h"
#include "engine/render/settings.h"
#include "shaders/shared/look.h"

namespace mesher::render {

/// The sets of texture coordinates that a model has.
struct TexcoordSets {
  std::array<bool, shared::kTexcoordSets> exists{};
  std::array<bool, shared::kTexcoordSets> counts_down{};
  friend bool operator==(const TexcoordSets&, const TexcoordSets&) = default;
};
TexcoordSets texcoord_sets(const Attributes& attributes);

/// An image as the GPU needs it: the same image may be used as color and as numbers.
struct TextureKey {
  std::uint32_t image = kNone;  ///< none: a white pixel
  bool is_srgb = false;
  friend auto operator<=>(const TextureKey&, const TextureKey&) = default;
};

/// A material for the shaders, with its textures by their bindings.
struct PackedMaterial {
  shared::MaterialBlock block{};
  std::array<TextureKey, shared::kTextureCount> textures;
  std::array<gpu::SamplerOptions, shared::kTextureCount> samplers;
};

/// Packs a material. Textures that the look does not show are left out. A texture without its
/// coordinates is left out too, as is one that needs a third set of them or a later one than
/// TEXCOORD_3; `problems` gets a line for it.
PackedMaterial pack(const Material& material, const TexcoordSets& sets, Look look,
                    std::vector<std::string>& problems);

/// The material of faces that have none: white and rough, seen from both sides.
Material plain_material();

}  // namespace mesher::render
