#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "engine/core/image.h"
#include "engine/gpu/buffer.h"

namespace mesher::gpu {

/// An 8-bit RGBA image with its mip levels, to be sampled by fragment shaders.
class Texture {
 public:
  Texture() = default;
  /// Uploads an image and its mip levels, each half as wide and as high as the one before, rounded
  /// down, and at least 1. `is_srgb`: the bytes are color. `staging` is replaced if it is too
  /// small, so that several textures can share it. Waits for the GPU. Pre: no side is 0. Throws
  /// DeviceError if a side exceeds the device's limit, or memory runs out.
  Texture(Device& device, std::span<const ImageView> levels, bool is_srgb, Buffer& staging);

  VkImageView view() const { return view_.get(); }
  explicit operator bool() const { return static_cast<bool>(image_); }

 private:
  Memory memory_;
  UniqueImage image_;
  UniqueImageView view_;
};

/// How textures are sampled.
struct SamplerOptions {
  VkSamplerAddressMode wrap_u = VK_SAMPLER_ADDRESS_MODE_REPEAT;
  VkSamplerAddressMode wrap_v = VK_SAMPLER_ADDRESS_MODE_REPEAT;
  bool magnifies_to_pixels = false;  ///< nearest rather than linear
  bool minifies_to_pixels = false;   ///< nearest rather than linear, within a level
  bool has_mipmaps = true;
  bool blends_mipmaps = true;
  friend auto operator<=>(const SamplerOptions&, const SamplerOptions&) = default;
};

UniqueSampler create_sampler(Device& device, const SamplerOptions& options);

/// Creates the layout of a set: `textures` combined images and samplers for fragment shaders at
/// binding 0, and a uniform block for all shaders at binding 1.
UniqueSetLayout create_texture_layout(Device& device, std::uint32_t textures);

/// A texture and how it is sampled.
struct TextureBinding {
  VkImageView view = VK_NULL_HANDLE;
  VkSampler sampler = VK_NULL_HANDLE;
};

/// The contents of some sets of one layout.
struct TextureSetContents {
  std::span<const TextureBinding> textures;  ///< those of the first set, then of the second...
  VkBuffer blocks = VK_NULL_HANDLE;          ///< a block for each set, one after another
  VkDeviceSize block_bytes = 0;  ///< a multiple of the device's minUniformBufferOffsetAlignment
};

/// Descriptor sets of one layout.
class TextureSets {
 public:
  TextureSets() = default;
  /// Creates `count` sets. Throws DeviceError.
  TextureSets(Device& device, VkDescriptorSetLayout layout, std::uint32_t count,
              const TextureSetContents& contents);

  VkDescriptorSet set(std::size_t i) const { return sets_[i]; }

 private:
  void create(Device& device, VkDescriptorSetLayout layout, std::uint32_t count,
              std::uint32_t textures);

  UniqueDescriptorPool pool_;
  std::vector<VkDescriptorSet> sets_;
};

}  // namespace mesher::gpu
