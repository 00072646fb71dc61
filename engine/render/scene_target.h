#pragma once

#include "engine/gpu/device_image.h"

namespace mesher::render {

/// The image a scene is drawn into, with depth and (at 4 samples) what is resolved into it. Color
/// is encoded sRGB; blending and resolving happen on linear light.
class SceneTarget {
 public:
  static constexpr VkFormat kDepthFormat = VK_FORMAT_D32_SFLOAT;

  /// `output_format` is that of the images copied to (Presenter::format()): R8G8B8A8_UNORM or
  /// B8G8R8A8_UNORM. `samples` 1 or 4; 1 where the device has no 4. Throws DeviceError where the
  /// size is beyond the device.
  SceneTarget(gpu::Device& device, VkExtent2D extent, unsigned samples,
              VkFormat output_format = VK_FORMAT_R8G8B8A8_UNORM);

  VkExtent2D extent() const { return color_.extent(); }
  VkFormat format() const { return color_.format(); }
  VkSampleCountFlagBits samples() const { return samples_; }
  /// One sample a pixel; kTransferSource after Renderer::draw.
  const gpu::DeviceImage& color() const { return color_; }
  const gpu::DeviceImage& multisampled() const { return multisampled_; }  ///< empty at 1 sample
  const gpu::DeviceImage& depth() const { return depth_; }

  /// Copies the color, byte for byte, to an image of the output format and this size, whatever was
  /// in it, and leaves that as kColorAttachment, ready for an overlay. A scene that has not changed
  /// need not be drawn again: copying is enough. Pre: drawn at least once.
  void copy_to(VkCommandBuffer commands, VkImage image) const;

 private:
  VkSampleCountFlagBits samples_;
  gpu::DeviceImage color_;
  gpu::DeviceImage multisampled_;
  gpu::DeviceImage depth_;
};

}  // namespace mesher::render
