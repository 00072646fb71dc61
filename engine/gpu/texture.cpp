#include "engine/gpu/texture.h"

#include <fmt/format.h>

#include <array>
#include <cstring>
#include <vector>

#include "engine/core/assert.h"
#include "engine/core/error.h"
#include "engine/gpu/device_image.h"
#include "engine/gpu/result.h"

namespace mesher::gpu {
namespace {

constexpr ImageState kSampled{VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL,
                              VK_PIPELINE_STAGE_2_FRAGMENT_SHADER_BIT,
                              VK_ACCESS_2_SHADER_SAMPLED_READ_BIT};

void check_texture_size(const Device& device, const ImageView& image) {
  const std::uint32_t limit = device.properties().limits.maxImageDimension2D;
  if (image.width <= limit && image.height <= limit) return;
  throw DeviceError(
      fmt::format("a texture of {}x{} pixels is not possible: {} supports {} per side", image.width,
                  image.height, device.name(), limit));
}

VkImage create_texture_image(Device& device, std::span<const ImageView> levels, VkFormat format) {
  check_texture_size(device, levels.front());
  const VkImageCreateInfo info{.sType = VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO,
                               .pNext = nullptr,
                               .flags = 0,
                               .imageType = VK_IMAGE_TYPE_2D,
                               .format = format,
                               .extent = {levels.front().width, levels.front().height, 1},
                               .mipLevels = static_cast<std::uint32_t>(levels.size()),
                               .arrayLayers = 1,
                               .samples = VK_SAMPLE_COUNT_1_BIT,
                               .tiling = VK_IMAGE_TILING_OPTIMAL,
                               .usage = VK_IMAGE_USAGE_SAMPLED_BIT |
                                        VK_IMAGE_USAGE_TRANSFER_SRC_BIT |
                                        VK_IMAGE_USAGE_TRANSFER_DST_BIT,
                               .sharingMode = VK_SHARING_MODE_EXCLUSIVE,
                               .queueFamilyIndexCount = 0,
                               .pQueueFamilyIndices = nullptr,
                               .initialLayout = VK_IMAGE_LAYOUT_UNDEFINED};
  VkImage handle = VK_NULL_HANDLE;
  check(vkCreateImage(device.handle(), &info, nullptr, &handle), "vkCreateImage");
  return handle;
}

/// Records the copy of all levels, which follow one another in `pixels`.
void record_upload(VkCommandBuffer commands, VkImage texture, const Buffer& pixels,
                   std::span<const ImageView> levels) {
  transition(commands, texture, kUndefined, kTransferTarget);
  std::vector<VkBufferImageCopy> regions;
  VkDeviceSize offset = 0;
  for (const ImageView& level : levels) {
    const auto number = static_cast<std::uint32_t>(regions.size());
    regions.push_back({.bufferOffset = offset,
                       .bufferRowLength = 0,
                       .bufferImageHeight = 0,
                       .imageSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, number, 0, 1},
                       .imageOffset = {0, 0, 0},
                       .imageExtent = {level.width, level.height, 1}});
    offset += level.bytes();
  }
  vkCmdCopyBufferToImage(commands, pixels.handle(), texture, kTransferTarget.layout,
                         static_cast<std::uint32_t>(regions.size()), regions.data());
  transition(commands, texture, kTransferTarget, kSampled);
}

VkDeviceSize level_bytes(std::span<const ImageView> levels) {
  VkDeviceSize bytes = 0;
  for (const ImageView& level : levels)
    bytes += level.bytes();
  return bytes;
}

}  // namespace

Texture::Texture(Device& device, std::span<const ImageView> levels, bool is_srgb, Buffer& staging) {
  MESHER_ASSERT(!levels.empty() && levels.front().width > 0 && levels.front().height > 0);
  const VkFormat format = is_srgb ? VK_FORMAT_R8G8B8A8_SRGB : VK_FORMAT_R8G8B8A8_UNORM;
  image_ = UniqueImage(device, create_texture_image(device, levels, format));
  VkMemoryRequirements requirements{};
  vkGetImageMemoryRequirements(device.handle(), image_.get(), &requirements);
  memory_ = allocate(device, requirements, MemoryIntent::fixed);
  check(vkBindImageMemory(device.handle(), image_.get(), memory_.handle.get(), 0),
        "vkBindImageMemory");
  const VkImageViewCreateInfo info{
      .sType = VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO,
      .pNext = nullptr,
      .flags = 0,
      .image = image_.get(),
      .viewType = VK_IMAGE_VIEW_TYPE_2D,
      .format = format,
      .components = {},
      .subresourceRange = {VK_IMAGE_ASPECT_COLOR_BIT, 0, VK_REMAINING_MIP_LEVELS, 0, 1}};
  VkImageView view = VK_NULL_HANDLE;
  check(vkCreateImageView(device.handle(), &info, nullptr, &view), "vkCreateImageView");
  view_ = UniqueImageView(device, view);
  const VkDeviceSize bytes = level_bytes(levels);
  if (staging.size() < bytes) {
    staging = {};  // freed first, so that both never coexist
    staging = Buffer(device, bytes, 0, MemoryIntent::dynamic);
  }
  std::byte* end = staging.mapped();
  for (const ImageView& level : levels) {
    std::memcpy(end, level.rgba, level.bytes());
    end += level.bytes();
  }
  device.run_once(
      [&](VkCommandBuffer commands) { record_upload(commands, image_.get(), staging, levels); });
}

UniqueSampler create_sampler(Device& device, const SamplerOptions& options) {
  VkSamplerCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_SAMPLER_CREATE_INFO;
  info.magFilter = options.magnifies_to_pixels ? VK_FILTER_NEAREST : VK_FILTER_LINEAR;
  info.minFilter = options.minifies_to_pixels ? VK_FILTER_NEAREST : VK_FILTER_LINEAR;
  info.mipmapMode = options.has_mipmaps && options.blends_mipmaps ? VK_SAMPLER_MIPMAP_MODE_LINEAR
                                                                  : VK_SAMPLER_MIPMAP_MODE_NEAREST;
  info.addressModeU = options.wrap_u;
  info.addressModeV = options.wrap_v;
  info.addressModeW = VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE;
  // 0.25 rather than 0, so that magnification is still told from minification.
  info.maxLod = options.has_mipmaps ? VK_LOD_CLAMP_NONE : 0.25F;
  VkSampler sampler = VK_NULL_HANDLE;
  check(vkCreateSampler(device.handle(), &info, nullptr, &sampler), "vkCreateSampler");
  return {device, sampler};
}

UniqueSetLayout create_texture_layout(Device& device, std::uint32_t textures) {
  const std::array<VkDescriptorSetLayoutBinding, 2> bindings{
      {{.binding = 0,
        .descriptorType = VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER,
        .descriptorCount = textures,
        .stageFlags = VK_SHADER_STAGE_FRAGMENT_BIT,
        .pImmutableSamplers = nullptr},
       {.binding = 1,
        .descriptorType = VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER,
        .descriptorCount = 1,
        .stageFlags = VK_SHADER_STAGE_VERTEX_BIT | VK_SHADER_STAGE_FRAGMENT_BIT,
        .pImmutableSamplers = nullptr}}};
  const VkDescriptorSetLayoutCreateInfo info{
      .sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO,
      .pNext = nullptr,
      .flags = 0,
      .bindingCount = bindings.size(),
      .pBindings = bindings.data()};
  VkDescriptorSetLayout layout = VK_NULL_HANDLE;
  check(vkCreateDescriptorSetLayout(device.handle(), &info, nullptr, &layout),
        "vkCreateDescriptorSetLayout");
  return {device, layout};
}

void TextureSets::create(Device& device, VkDescriptorSetLayout layout, std::uint32_t count,
                         std::uint32_t textures) {
  const std::array<VkDescriptorPoolSize, 2> sizes{
      {{VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, count * textures},
       {VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER, count}}};
  const VkDescriptorPoolCreateInfo info{.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO,
                                        .pNext = nullptr,
                                        .flags = 0,
                                        .maxSets = count,
                                        .poolSizeCount = sizes.size(),
                                        .pPoolSizes = sizes.data()};
  VkDescriptorPool pool = VK_NULL_HANDLE;
  check(vkCreateDescriptorPool(device.handle(), &info, nullptr, &pool), "vkCreateDescriptorPool");
  pool_ = UniqueDescriptorPool(device, pool);
  const std::vector<VkDescriptorSetLayout> layouts(count, layout);
  const VkDescriptorSetAllocateInfo allocation{
      .sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO,
      .pNext = nullptr,
      .descriptorPool = pool,
      .descriptorSetCount = count,
      .pSetLayouts = layouts.data()};
  sets_.resize(count);
  check(vkAllocateDescriptorSets(device.handle(), &allocation, sets_.data()),
        "vkAllocateDescriptorSets");
}

TextureSets::TextureSets(Device& device, VkDescriptorSetLayout layout, std::uint32_t count,
                         const TextureSetContents& contents) {
  const auto textures = static_cast<std::uint32_t>(contents.textures.size() / count);
  create(device, layout, count, textures);
  std::vector<VkDescriptorImageInfo> images;
  images.reserve(contents.textures.size());
  for (const TextureBinding& binding : contents.textures)
    images.push_back({binding.sampler, binding.view, kSampled.layout});
  std::vector<VkDescriptorBufferInfo> blocks;
  for (std::uint32_t i = 0; i < count; ++i)
    blocks.push_back({contents.blocks, i * contents.block_bytes, contents.block_bytes});
  std::vector<VkWriteDescriptorSet> writes;
  for (std::uint32_t i = 0; i < count; ++i) {
    VkWriteDescriptorSet write{};
    write.sType = VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET;
    write.dstSet = sets_[i];
    write.descriptorCount = textures;
    write.descriptorType = VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER;
    write.pImageInfo = images.data() + std::size_t{i} * textures;
    writes.push_back(write);
    write.dstBinding = 1;
    write.descriptorCount = 1;
    write.descriptorType = VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER;
    write.pImageInfo = nullptr;
    write.pBufferInfo = &blocks[i];
    writes.push_back(write);
  }
  vkUpdateDescriptorSets(device.handle(), static_cast<std::uint32_t>(writes.size()), writes.data(),
                         0, nullptr);
}

}  // namespace mesher::gpu
