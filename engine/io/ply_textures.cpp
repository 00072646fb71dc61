#include "engine/io/ply_textures.h"

#include <algorithm>
#include <filesystem>
#include <memory>
#include <utility>

#include "engine/core/text.h"
#include "engine/io/beside.h"
#include "engine/io/image_files.h"

namespace mesher::io {
namespace {

bool fits_ply(const Texture& texture, const Materials& materials) {
  if (!texture.is_there() || texture.set != 0) return false;
  const bool is_plain = texture.offset == glm::vec2(0.0F) && texture.scale == glm::vec2(1.0F) &&
                        texture.angle_rad == 0.0F;
  const EncodedImage& image = materials.images[texture.image];
  return is_plain && (image.bytes != nullptr || !image.path.empty());
}

}  // namespace

void PlyFaceTextures::add_face(std::int64_t texnumber) {
  if (textures_ == 0) return;
  const bool is_known = texnumber >= 0 && static_cast<std::uint64_t>(texnumber) < textures_;
  if (!is_known && texnumber >= 0) ++out_of_range_;
  group_.push_back(static_cast<std::uint32_t>(is_known ? texnumber : std::int64_t(textures_)));
}

void PlyFaceTextures::finish(Soup& soup) {
  if (textures_ == 0) return;
  soup.attributes.group = std::move(group_);
  for (std::uint32_t i = 0; i < textures_; ++i)
    soup.attributes.groups.push_back({.material = i});
  soup.attributes.groups.emplace_back();
  if (out_of_range_ > 0) {
    soup.contents.warn(count_phrase(static_cast<std::int64_t>(out_of_range_),
                                    "{face|faces} with a texnumber out of range: no texture"));
  }
}

void add_ply_materials(const MappedFile& ply, const std::vector<std::string>& textures,
                       Soup& soup) {
  if (textures.empty()) return;
  Materials materials;
  ImageFiles files(soup.contents);
  const std::filesystem::path folder = std::filesystem::path(ply.name()).parent_path();
  for (const std::string& texture : textures) {
    const auto index = static_cast<std::uint32_t>(materials.images.size());
    EncodedImage& image = materials.images.emplace_back(EncodedImage{.path = texture});
    files.load(image, find_named_beside(folder, texture), texture);
    Material& material = materials.materials.emplace_back();
    material.name = std::filesystem::path(texture).stem().string();
    material.base_color_texture.image = index;
    material.metallic = 0.0F;
  }
  materials.texture_count = static_cast<std::uint32_t>(textures.size());
  soup.materials = std::make_shared<const Materials>(std::move(materials));
}

PlyTextures ply_textures(const Materials& materials) {
  PlyTextures textures;
  for (const Material& material : materials.materials) {
    std::uint32_t& number = textures.of_material.emplace_back(kNone);
    if (!fits_ply(material.base_color_texture, materials)) continue;
    const std::uint32_t image = material.base_color_texture.image;
    const auto known = std::ranges::find(textures.images, image);
    number = static_cast<std::uint32_t>(known - textures.images.begin());
    if (known == textures.images.end()) textures.images.push_back(image);
  }
  return textures;
}

}  // namespace mesher::io
