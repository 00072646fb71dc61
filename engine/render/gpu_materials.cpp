#include "engine/render/gpu_materials.h"

#include <set>
#include <span>

#include "engine/render/mip_levels.h"
#include "engine/render/texture_detail.h"

namespace mesher::render {
namespace {

Image white_pixel() {
  return {.width = 1, .height = 1, .rgba = Array<std::uint8_t>(4, 255)};
}

/// Returns the images of the textures, each once, in ascending order.
std::vector<ImageRequest> requests_for(const std::set<TextureKey>& keys,
                                       const std::vector<float>& needed_sides) {
  std::vector<ImageRequest> requests;
  for (const TextureKey& key : keys) {
    if (key.image == kNone || (!requests.empty() && requests.back().image == key.image)) continue;
    requests.push_back({.image = key.image});
    if (key.image < needed_sides.size()) requests.back().needed_side = needed_sides[key.image];
  }
  return requests;
}

std::vector<Material> with_plain(const Materials* materials) {
  std::vector<Material> all;
  if (materials != nullptr) all = materials->materials;
  all.push_back(plain_material());
  return all;
}

}  // namespace

void GpuMaterials::update(const Mesh& mesh, const Appearance& appearance, Look look) {
  const TexcoordSets texcoords = texcoord_sets(*appearance.attributes);
  const bool is_same_model =
      blocks_ && materials_ == appearance.materials && picture_ == appearance.picture;
  if (is_same_model && texcoords == texcoords_ && look == look_) return;
  look_ = Look::clay;  // until everything has succeeded
  if (!is_same_model) textures_.clear();
  problems_.clear();
  is_two_sided_.clear();
  std::vector<PackedMaterial> packed;
  std::vector<shared::MaterialBlock> blocks;
  for (const Material& material : with_plain(appearance.materials.get())) {
    packed.push_back(pack(material, texcoords, look, problems_));
    blocks.push_back(packed.back().block);
    is_two_sided_.push_back(material.is_two_sided);
  }
  materials_ = appearance.materials;
  picture_ = appearance.picture;
  texcoords_ = texcoords;
  create_textures(mesh, appearance, packed);
  const auto bytes = std::as_bytes(std::span(blocks));
  blocks_ = gpu::Buffer(device_, bytes.size(), VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT,
                        gpu::MemoryIntent::fixed);
  gpu::upload(device_, blocks_, bytes);
  create_sets(packed);
  look_ = look;
}

void GpuMaterials::create_textures(const Mesh& mesh, const Appearance& appearance,
                                   const std::vector<PackedMaterial>& packed) {
  std::set<TextureKey> missing;
  for (const PackedMaterial& material : packed) {
    for (const TextureKey& key : material.textures) {
      if (!textures_.contains(key)) missing.insert(key);
    }
  }
  std::vector<float> sides;
  if (appearance.picture)
    sides =
        needed_sides(mesh, *appearance.attributes, {packed, is_two_sided_}, *appearance.picture);
  const std::vector<ImageRequest> requests = requests_for(missing, sides);
  gpu::Buffer staging;
  if (appearance.decode && !requests.empty()) {
    appearance.decode(requests, [&](std::size_t i, const ImageView& image) {
      for (const bool is_srgb : {false, true}) {
        const TextureKey key{requests[i].image, is_srgb};
        if (missing.contains(key)) create_texture(key, image, requests[i].needed_side, staging);
      }
    });
  }
  for (const TextureKey& key : missing) {
    if (!textures_.contains(key)) create_texture(key, white_pixel(), 1.0F, staging);
  }
}

void GpuMaterials::create_texture(const TextureKey& key, const ImageView& image, float needed_side,
                                  gpu::Buffer& staging) {
  const std::vector<Image> smaller = mip_levels(image, key.is_srgb);
  std::vector<ImageView> levels{image};
  levels.insert(levels.end(), smaller.begin(), smaller.end());
  const auto needed = std::span(levels).subspan(halvings(image.width, image.height, needed_side));
  textures_.emplace(key, gpu::Texture(device_, needed, key.is_srgb, staging));
}

void GpuMaterials::create_sets(const std::vector<PackedMaterial>& packed) {
  std::vector<gpu::TextureBinding> bindings;
  for (const PackedMaterial& material : packed) {
    for (std::uint32_t i = 0; i < shared::kTextureCount; ++i) {
      gpu::UniqueSampler& sampler = samplers_[material.samplers[i]];
      if (!sampler) sampler = gpu::create_sampler(device_, material.samplers[i]);
      bindings.push_back({textures_.at(material.textures[i]).view(), sampler.get()});
    }
  }
  sets_ = gpu::TextureSets(device_, layout_.get(), static_cast<std::uint32_t>(packed.size()),
                           {.textures = bindings,
                            .blocks = blocks_.handle(),
                            .block_bytes = sizeof(shared::MaterialBlock)});
}

}  // namespace mesher::render
