#pragma once

#include "engine/gpu/device_image.h"

namespace mesher::render {

/// The image that a scene is drawn into, with depth and (at 4 samples) the multisampled image that
/// is resolved into it. Color is sRGB-encoded; blending and resolving happen in linear light.
class SceneTarget {
 public:
  static constexpr VkFormat kDepthFormat = VK_FORMAT_D32_SFLOAT;

  /// `output_format` is the format of the images copied to (Presenter::format()): R8G8B8A8_UNORM or
  /// B8G8R8A8_UNORM. `samples` is 1 or 4; devices without 4 use 1. Throws DeviceError if the size
  /// exceeds the device's limit.
  SceneTarget(gpu::Device& device, VkExtent2D extent, unsigned samples,
              VkFormat output_format = VK_FORMAT_R8G8B8A8_UNORM);

  VkExtent2D extent() const { return color_.extent(); }
  VkFormat format() const { return color_.format(); }
  VkSampleCountFlagBits samples() const { return samples_; }
  /// Returns the image with one sample per pixel; in kTransferSource after Renderer::draw.
  const gpu::DeviceImage& color() const { return color_; }
  const gpu::DeviceImage& multisampled() const { return multisampled_; }  ///< empty at 1 sample
  const gpu::DeviceImage& depth() const { return depth_; }

  /// Copies the color, byte for byte, to an image of the output format, with the top left corner at
  /// `offset`.
  ///
  /// Leaves the image in kColorAttachment, ready for an overlay. What the image held before is
  /// lost: the overlay has to cover the part beside the copy. An unchanged scene need not be drawn
  /// again: copying is enough. Pre: drawn at least once; the copy lies inside the image.
  void copy_to(VkCommandBuffer commands, VkImage image, VkOffset2D offset = {0, 0}) const;

 private:
  VkSampleCountFlagBits samples_;
  gpu::DeviceImage color_;
  gpu::DeviceImage multisampled_;
  gpu::DeviceImage depth_;
};

}  // namespace mesher::render
