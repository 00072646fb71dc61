#include "engine/gpu/device_image.h"

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <utility>

#include "engine/core/error.h"
#include "engine/core/text.h"
#include "engine/gpu/buffer.h"
#include "engine/gpu/memory_barrier.h"
#include "engine/gpu/result.h"

namespace mesher::gpu {
namespace {

void check_size(const Device& device, const DeviceImageOptions& options) {
  const auto [width, height] = options.extent;
  const std::uint32_t limit = device.properties().limits.maxImageDimension2D;
  constexpr VkDeviceSize kTexelBytes = 4;  // for every format used here
  const bool has_size = width > 0 && height > 0 && width <= limit && height <= limit;
  if (has_size && kTexelBytes * width * height * options.samples <= device.max_allocation_bytes()) {
    return;
  }
  throw DeviceError(fmt::format(
      "a picture of {}x{} pixels is not possible: {} supports 1 to {} pixels per side and {} in "
      "total",
      width, height, device.name(), limit, bytes_text(device.max_allocation_bytes())));
}

VkImage create_image(Device& device, const DeviceImageOptions& options) {
  check_size(device, options);
  const VkImageCreateInfo info{.sType = VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO,
                               .pNext = nullptr,
                               .flags = 0,
                               .imageType = VK_IMAGE_TYPE_2D,
                               .format = options.format,
                               .extent = {options.extent.width, options.extent.height, 1},
                               .mipLevels = 1,
                               .arrayLayers = 1,
                               .samples = options.samples,
                               .tiling = VK_IMAGE_TILING_OPTIMAL,
                               .usage = options.usage,
                               .sharingMode = VK_SHARING_MODE_EXCLUSIVE,
                               .queueFamilyIndexCount = 0,
                               .pQueueFamilyIndices = nullptr,
                               .initialLayout = VK_IMAGE_LAYOUT_UNDEFINED};
  VkImage image = VK_NULL_HANDLE;
  check(vkCreateImage(device.handle(), &info, nullptr, &image), "vkCreateImage");
  return image;
}

VkImageAspectFlags aspect_of(VkFormat format) {
  return format == VK_FORMAT_D32_SFLOAT ? VK_IMAGE_ASPECT_DEPTH_BIT : VK_IMAGE_ASPECT_COLOR_BIT;
}

bool is_bgra(VkFormat format) {
  return format == VK_FORMAT_B8G8R8A8_UNORM || format == VK_FORMAT_B8G8R8A8_SRGB;
}

void record_read(VkCommandBuffer commands, const DeviceImage& image, ImageState state,
                 const Buffer& pixels) {
  transition(commands, image.handle(), state, kTransferSource);
  const VkBufferImageCopy region{.bufferOffset = 0,
                                 .bufferRowLength = 0,
                                 .bufferImageHeight = 0,
                                 .imageSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1},
                                 .imageOffset = {0, 0, 0},
                                 .imageExtent = {image.extent().width, image.extent().height, 1}};
  vkCmdCopyImageToBuffer(commands, image.handle(), VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL,
                         pixels.handle(), 1, &region);
  transition(commands, image.handle(), kTransferSource, state);
  memory_barrier(commands, {VK_PIPELINE_STAGE_2_TRANSFER_BIT, VK_ACCESS_2_TRANSFER_WRITE_BIT},
                 {VK_PIPELINE_STAGE_2_HOST_BIT, VK_ACCESS_2_HOST_READ_BIT});
}

}  // namespace

DeviceImage::DeviceImage(Device& device, const DeviceImageOptions& options)
    : image_(device, create_image(device, options)),
      format_(options.format),
      extent_(options.extent) {
  VkMemoryRequirements requirements{};
  vkGetImageMemoryRequirements(device.handle(), image_.get(), &requirements);
  memory_ = allocate(device, requirements, MemoryIntent::fixed);
  check(vkBindImageMemory(device.handle(), image_.get(), memory_.handle.get(), 0),
        "vkBindImageMemory");
  const VkImageViewCreateInfo info{.sType = VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO,
                                   .pNext = nullptr,
                                   .flags = 0,
                                   .image = image_.get(),
                                   .viewType = VK_IMAGE_VIEW_TYPE_2D,
                                   .format = options.format,
                                   .components = {},
                                   .subresourceRange = {aspect_of(options.format), 0, 1, 0, 1}};
  VkImageView view = VK_NULL_HANDLE;
  check(vkCreateImageView(device.handle(), &info, nullptr, &view), "vkCreateImageView");
  view_ = UniqueImageView(device, view);
}

void transition(VkCommandBuffer commands, VkImage image, ImageState from, ImageState to,
                VkImageAspectFlags aspect) {
  const bool discards = from.layout == VK_IMAGE_LAYOUT_UNDEFINED;
  const VkImageMemoryBarrier2 barrier{
      .sType = VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER_2,
      .pNext = nullptr,
      .srcStageMask = discards ? to.stage : from.stage,
      .srcAccessMask = discards ? to.access : from.access,
      .dstStageMask = to.stage,
      .dstAccessMask = to.access,
      .oldLayout = from.layout,
      .newLayout = to.layout,
      .srcQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED,
      .dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED,
      .image = image,
      .subresourceRange = {aspect, 0, VK_REMAINING_MIP_LEVELS, 0, 1}};
  VkDependencyInfo dependency{};
  dependency.sType = VK_STRUCTURE_TYPE_DEPENDENCY_INFO;
  dependency.imageMemoryBarrierCount = 1;
  dependency.pImageMemoryBarriers = &barrier;
  vkCmdPipelineBarrier2(commands, &dependency);
}

mesher::Image read_image(Device& device, const DeviceImage& image, ImageState state) {
  const VkExtent2D extent = image.extent();
  const VkDeviceSize bytes = VkDeviceSize{4} * extent.width * extent.height;
  const Buffer pixels(device, bytes, 0, MemoryIntent::readback);
  device.run_once([&](VkCommandBuffer commands) { record_read(commands, image, state, pixels); });
  mesher::Image result;
  result.width = extent.width;
  result.height = extent.height;
  result.rgba.resize(bytes);
  const auto* source = reinterpret_cast<const std::uint8_t*>(pixels.mapped());
  std::copy(source, source + bytes, result.rgba.begin());
  if (is_bgra(image.format())) {
    for (std::size_t i = 0; i < bytes; i += 4)
      std::swap(result.rgba[i], result.rgba[i + 2]);
  }
  return result;
}

}  // namespace mesher::gpu
