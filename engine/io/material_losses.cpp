#include "engine/io/material_losses.h"

#include <map>
#include <set>

#include "engine/core/text.h"
#include "engine/io/gltf_material_write.h"
#include "engine/io/mtl_look.h"

namespace mesher::io {
namespace {

/// Collects the images that glTF writes, and counts textures without coordinates.
std::set<std::uint32_t> used_images(const Materials& materials, std::uint32_t uv_sets,
                                    std::int64_t& without_uv) {
  std::set<std::uint32_t> used;
  for (const Material& material : materials.materials) {
    for (const Texture* texture :
         {&material.base_color_texture, &material.metallic_roughness_texture,
          &material.normal_texture, &material.occlusion_texture, &material.emission_texture}) {
      if (!texture->is_there()) continue;
      used.insert(texture->image);
      without_uv += texture->set >= uv_sets ? 1 : 0;
    }
  }
  return used;
}

std::string image_label(const EncodedImage& image, std::uint32_t index) {
  if (!image.path.empty()) return image.path.string();
  return image.name.empty() ? std::to_string(index) : image.name;
}

}  // namespace

std::uint32_t count_uv_sets(const Attributes& attributes) {
  std::uint32_t sets = 0;
  while (attributes.find("TEXCOORD_" + std::to_string(sets)) != nullptr)
    ++sets;
  return sets;
}

std::vector<std::string> material_losses(const Materials& materials, HoldsMaterials holds,
                                         std::uint32_t uv_sets) {
  std::vector<std::string> losses;
  if (!holds_look(holds)) return losses;
  const bool is_mtl = holds == HoldsMaterials::as_mtl;
  std::map<std::string, std::int64_t> counts;
  for (const Material& material : materials.materials) {
    for (const std::string& name : is_mtl ? lost_in_mtl(material) : lost_in_gltf(material))
      ++counts[name];
  }
  for (const auto& [name, count] : counts)
    losses.push_back(name + " of " + count_text(count, "material"));
  std::int64_t without_uv = 0;
  const std::set<std::uint32_t> used = used_images(materials, uv_sets, without_uv);
  if (!is_mtl && without_uv > 0)
    losses.push_back(count_text(without_uv, "texture") + " without texture coordinates");
  for (const std::uint32_t i : used) {
    const EncodedImage& image = materials.images[i];
    const std::string label = "texture " + image_label(image, i);
    // OBJ keeps the name of a file that is missing.
    const bool is_missing = !image.bytes && (!is_mtl || image.path.empty());
    if (is_missing) losses.push_back(label + " (it could not be read)");
    if (!is_mtl && image.bytes && !can_embed(image))
      losses.push_back(label + " (glTF has no such images)");
  }
  return losses;
}

}  // namespace mesher::io
