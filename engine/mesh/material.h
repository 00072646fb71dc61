#pragma once

#include <cstdint>
#include <filesystem>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "engine/mesh/ids.h"

namespace mesher {

/// An image as its file stores it.
struct EncodedImage {
  std::string name;
  std::string mime_type;       ///< "image/png"; empty if unknown
  std::filesystem::path path;  ///< as the model's file names it, relative to it; empty: embedded
  /// The encoded bytes; null if the file is missing or lies outside the model's folder.
  std::shared_ptr<const std::string> bytes;
};

/// What a texture returns beyond its edges.
enum class Wrap : std::uint8_t { repeat, mirrored_repeat, clamp };

/// Which smaller versions of an image a texture uses where the image is minified.
enum class Mipmaps : std::uint8_t {
  none,
  nearest,  ///< the one of the nearest size
  blended,  ///< the two of the nearest sizes
};

/// How a material uses an image.
struct Texture {
  std::uint32_t image = kNone;  ///< index into Materials::images; kNone: there is no texture
  std::uint32_t set = 0;        ///< of the texture coordinates: TEXCOORD_<set>
  Wrap wrap_u = Wrap::repeat;
  Wrap wrap_v = Wrap::repeat;
  bool magnifies_to_pixels = false;  ///< nearest rather than linear
  bool minifies_to_pixels = false;   ///< nearest rather than linear, within a level
  Mipmaps mipmaps = Mipmaps::blended;
  /// The transform of texture coordinates that count v from the top (KHR_texture_transform):
  /// offset + rotation(-angle_rad) * (scale * uv).
  glm::vec2 offset{0.0F};
  glm::vec2 scale{1.0F};
  float angle_rad = 0.0F;
  /// Factor of what the texture holds: the slope of a normal map, the strength of occlusion.
  float strength = 1.0F;

  bool is_there() const { return image != kNone; }
};

enum class AlphaMode : std::uint8_t {
  opaque,
  mask,   ///< drawn where alpha is at least the cutoff
  blend,  ///< mixed with what is behind
};

/// What a surface looks like, in the terms of glTF 2.0 (metallic-roughness). Textures with color
/// (base color, emission) are sRGB; factors are linear.
struct Material {
  std::string name;
  glm::vec4 base_color{1.0F};
  Texture base_color_texture;
  float metallic = 1.0F;
  float roughness = 1.0F;
  Texture metallic_roughness_texture;  ///< blue is metallic, green is roughness
  Texture normal_texture;              ///< in tangent space, green is up
  Texture occlusion_texture;           ///< red
  glm::vec3 emission{0.0F};
  Texture emission_texture;
  AlphaMode alpha = AlphaMode::opaque;
  float alpha_cutoff = 0.5F;
  bool is_two_sided = false;
  bool is_unlit = false;      ///< KHR_materials_unlit: shown in its base color
  bool is_name_only = false;  ///< the file that describes it is missing; the look is a default
  /// The lines of an MTL file after `newmtl`, as written. OBJ gets them back, because the terms
  /// above cannot express all of them. None: the material comes from another format.
  std::optional<std::vector<std::string>> mtl_statements;
};

/// The materials of a model with their images. A FaceGroup refers to them.
struct Materials {
  std::vector<Material> materials;
  std::vector<EncodedImage> images;
  std::uint32_t texture_count = 0;         ///< textures of the file that the materials hold
  std::vector<std::string> missing_files;  ///< MTL files that could not be read; OBJ names them
};

}  // namespace mesher
