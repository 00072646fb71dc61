#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/io/mtl_statement.h"
#include "engine/mesh/material.h"

namespace mesher::io {

// Translation between the statements of MTL and the terms of glTF. MTL has no standard beyond the
// description of Wavefront's, and programs differ; these are the conventions here, in both
// directions:
// - Colors (Kd, Ke) are sRGB, as a color picker shows them, and glTF's factors are linear.
// - Ns is the exponent of Blinn-Phong. The lobe of GGX that is about as wide has
//   alpha^2 = 2 / (Ns + 2) (B. Walter et al., "Microfacet models for refraction through rough
//   surfaces", 2007), and glTF's roughness is the root of alpha. `Pr` and `Pm` (roughness and
//   metallic of the PBR extension) count more than Ns.
// - `illum 0` is unlit, and with `illum 1` or a black Ks nothing shines: roughness 1.
// - d is opacity and Tr is 1 - d. Below 1, the surface is blended; so it is if map_d is the image
//   of map_Kd. (Its alpha alone says nothing.)
// - `-s` and `-o` make of uv the coordinates s * uv + o.
// - `norm` is a normal map and -bm its strength. Bump maps hold heights: they have no counterpart.
// - map_Pr with `-imfchan g` and map_Pm with `-imfchan b` of one image are glTF's texture.

/// Collects the statements of one material.
class MtlLook {
 public:
  /// `image_of` returns the index in Materials::images of a file that a map names.
  explicit MtlLook(std::function<std::uint32_t(std::string_view)> image_of)
      : image_of_(std::move(image_of)) {}

  /// Takes in a statement. Returns whether it is well-formed; unknown ones are.
  bool add(std::string_view line);
  /// Sets the material's terms, but not its name and statements.
  void finish(Material& material) const;

 private:
  bool add_map(const MtlStatement& statement);
  Texture texture(const MtlMap& map, bool is_normal_map) const;

  std::function<std::uint32_t(std::string_view)> image_of_;
  std::optional<glm::vec3> diffuse_, specular_, emission_;
  std::optional<float> opacity_, exponent_, roughness_, metallic_;
  int illumination_ = 2;
  Texture diffuse_map_, emission_map_, normal_map_, opacity_map_, roughness_map_, metallic_map_;
  char roughness_channel_ = '\0';
  char metallic_channel_ = '\0';
};

/// Returns the statements of a material that has none of its own. `files` are the names of its
/// images; an empty one is left out.
std::vector<std::string> mtl_statements(const Material& material,
                                        const std::vector<std::string>& files);

/// Returns whether MTL can express how a texture is used, apart from details: OBJ has one set of
/// texture coordinates.
bool fits_mtl(const Texture& texture);

/// Returns the names of what a material's statements say that glTF does not hold, such as
/// "specular color" and "bump map".
std::vector<std::string> lost_in_gltf(const Material& material);
/// Returns the names of what a material of another format says that MTL does not hold.
std::vector<std::string> lost_in_mtl(const Material& material);

}  // namespace mesher::io
