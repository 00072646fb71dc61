#include "engine/render/scene_target.h"

#include "engine/core/assert.h"

namespace mesher::render {
namespace {

VkFormat encoded(VkFormat output_format) {
  MESHER_ASSERT(output_format == VK_FORMAT_B8G8R8A8_UNORM ||
                output_format == VK_FORMAT_R8G8B8A8_UNORM);
  return output_format == VK_FORMAT_B8G8R8A8_UNORM ? VK_FORMAT_B8G8R8A8_SRGB
                                                   : VK_FORMAT_R8G8B8A8_SRGB;
}

}  // namespace

SceneTarget::SceneTarget(gpu::Device& device, VkExtent2D extent, unsigned samples,
                         VkFormat output_format)
    : samples_(device.supported_samples(samples)),
      color_(device,
             {.format = encoded(output_format),
              .extent = extent,
              .usage = VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT}),
      depth_(device, {.format = kDepthFormat,
                      .extent = extent,
                      .usage = VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT,
                      .samples = samples_}) {
  if (samples_ == VK_SAMPLE_COUNT_1_BIT) return;
  multisampled_ =
      gpu::DeviceImage(device, {.format = color_.format(), .extent = extent, .samples = samples_});
}

void SceneTarget::copy_to(VkCommandBuffer commands, VkImage image, VkOffset2D offset) const {
  gpu::transition(commands, image, gpu::kUndefined, gpu::kTransferTarget);
  constexpr VkImageSubresourceLayers kColor{VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1};
  const VkImageCopy region{.srcSubresource = kColor,
                           .srcOffset = {0, 0, 0},
                           .dstSubresource = kColor,
                           .dstOffset = {offset.x, offset.y, 0},
                           .extent = {extent().width, extent().height, 1}};
  vkCmdCopyImage(commands, color_.handle(), VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, image,
                 VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, 1, &region);
  gpu::transition(commands, image, gpu::kTransferTarget, gpu::kColorAttachment);
}

}  // namespace mesher::render
