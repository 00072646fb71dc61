#pragma once

#include <cstdint>

#include "engine/core/image.h"
#include "engine/gpu/memory.h"

namespace mesher::gpu {

struct DeviceImageOptions {
  VkFormat format = VK_FORMAT_R8G8B8A8_UNORM;
  VkExtent2D extent{};
  VkImageUsageFlags usage = VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT;
  VkSampleCountFlagBits samples = VK_SAMPLE_COUNT_1_BIT;
};

/// A two-dimensional image with one mip level, its own memory and its own view.
class DeviceImage {
 public:
  DeviceImage() = default;
  /// Throws DeviceError.
  DeviceImage(Device& device, const DeviceImageOptions& options);

  VkImage handle() const { return image_.get(); }
  VkImageView view() const { return view_.get(); }
  VkFormat format() const { return format_; }
  VkExtent2D extent() const { return extent_; }
  explicit operator bool() const { return static_cast<bool>(image_); }

 private:
  Memory memory_;
  UniqueImage image_;
  UniqueImageView view_;
  VkFormat format_ = VK_FORMAT_UNDEFINED;
  VkExtent2D extent_{};
};

/// Layout of an image and its last access: one end of a barrier.
struct ImageState {
  VkImageLayout layout;
  VkPipelineStageFlags2 stage;
  VkAccessFlags2 access;
};
inline constexpr ImageState kUndefined{VK_IMAGE_LAYOUT_UNDEFINED, VK_PIPELINE_STAGE_2_NONE, 0};
inline constexpr ImageState kColorAttachment{
    VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL, VK_PIPELINE_STAGE_2_COLOR_ATTACHMENT_OUTPUT_BIT,
    VK_ACCESS_2_COLOR_ATTACHMENT_READ_BIT | VK_ACCESS_2_COLOR_ATTACHMENT_WRITE_BIT};
inline constexpr ImageState kDepthAttachment{
    VK_IMAGE_LAYOUT_DEPTH_ATTACHMENT_OPTIMAL,
    VK_PIPELINE_STAGE_2_EARLY_FRAGMENT_TESTS_BIT | VK_PIPELINE_STAGE_2_LATE_FRAGMENT_TESTS_BIT,
    VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_READ_BIT | VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_WRITE_BIT};
inline constexpr ImageState kTransferSource{VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL,
                                            VK_PIPELINE_STAGE_2_TRANSFER_BIT,
                                            VK_ACCESS_2_TRANSFER_READ_BIT};
inline constexpr ImageState kTransferTarget{VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL,
                                            VK_PIPELINE_STAGE_2_TRANSFER_BIT,
                                            VK_ACCESS_2_TRANSFER_WRITE_BIT};
inline constexpr ImageState kPresent{VK_IMAGE_LAYOUT_PRESENT_SRC_KHR, VK_PIPELINE_STAGE_2_NONE, 0};

/// Records a barrier between two uses of an image, with all its mip levels. From kUndefined, the
/// content is lost, and the barrier waits for earlier work at the stages of `to`.
void transition(VkCommandBuffer commands, VkImage image, ImageState from, ImageState to,
                VkImageAspectFlags aspect = VK_IMAGE_ASPECT_COLOR_BIT);

/// Returns an 8-bit RGBA or BGRA image as RGBA, with alpha unchanged. Waits for the GPU. Pre: the
/// last submission left the image in `state`, where it remains; it has
/// VK_IMAGE_USAGE_TRANSFER_SRC_BIT. Throws DeviceError.
mesher::Image read_image(Device& device, const DeviceImage& image, ImageState state);

}  // namespace mesher::gpu
