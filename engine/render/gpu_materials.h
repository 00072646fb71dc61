#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "engine/gpu/buffer.h"
#include "engine/gpu/texture.h"
#include "engine/mesh/material.h"
#include "engine/mesh/mesh.h"
#include "engine/render/material_block.h"
#include "engine/render/sources.h"

namespace mesher::render {

/// The GPU's materials and textures. Textures stay while the materials do, so that another look
/// uploads only those that it needs in addition.
class GpuMaterials {
 public:
  explicit GpuMaterials(gpu::Device& device)
      : device_(device), layout_(gpu::create_texture_layout(device, shared::kTextureCount)) {}

  /// Updates all from the model. `look` is not clay. Does nothing if all is as in the last call;
  /// for another picture, all textures are made again. Throws DeviceError.
  void update(const Mesh& mesh, const Appearance& appearance, Look look);

  /// Returns a material's block and textures. Materials are numbered as in Materials::materials;
  /// the last is for faces that have none.
  VkDescriptorSet set(std::uint32_t material) const { return sets_.set(material); }
  bool is_two_sided(std::uint32_t material) const { return is_two_sided_[material]; }
  /// What is not drawn, a line for each.
  const std::vector<std::string>& problems() const { return problems_; }

 private:
  /// Creates those that are missing, each while the other images are still being decoded.
  void create_textures(const Mesh& mesh, const Appearance& appearance,
                       const std::vector<PackedMaterial>& packed);
  void create_texture(const TextureKey& key, const ImageView& image, float needed_side,
                      gpu::Buffer& staging);
  void create_sets(const std::vector<PackedMaterial>& packed);

  gpu::Device& device_;
  gpu::UniqueSetLayout layout_;
  std::shared_ptr<const Materials> materials_;
  std::optional<PictureView> picture_;
  TexcoordSets texcoords_;
  Look look_ = Look::clay;
  std::map<TextureKey, gpu::Texture> textures_;
  std::map<gpu::SamplerOptions, gpu::UniqueSampler> samplers_;
  gpu::TextureSets sets_;
  gpu::Buffer blocks_;
  std::vector<bool> is_two_sided_;
  std::vector<std::string> problems_;
};

}  // namespace mesher::render
