#pragma once

#include <array>
#include <cstdint>
#include <memory>

#include "engine/gpu/device_image.h"
#include "engine/gpu/handles.h"
#include "engine/render/camera.h"
#include "engine/render/gpu_mesh.h"
#include "engine/render/settings.h"

namespace mesher::render {

/// The image a scene is drawn into, with depth and (at 4 samples) what is resolved into it. The
/// color is encoded sRGB; blending and resolving happen on linear light.
class SceneTarget {
 public:
  /// `output_format` is that of the images copied to (Presenter::format()), R8G8B8A8_UNORM or
  /// B8G8R8A8_UNORM. Throws DeviceError where the size is beyond the device.
  SceneTarget(gpu::Device& device, VkExtent2D extent, unsigned samples,
              VkFormat output_format = VK_FORMAT_R8G8B8A8_UNORM);

  VkExtent2D extent() const { return color_.extent(); }
  VkFormat format() const { return color_.format(); }
  VkSampleCountFlagBits samples() const { return samples_; }
  /// One sample; TRANSFER_SRC_OPTIMAL after Renderer::draw.
  const gpu::DeviceImage& color() const { return color_; }
  const gpu::DeviceImage& multisampled() const { return multisampled_; }  ///< empty at 1 sample
  const gpu::DeviceImage& depth() const { return depth_; }

  /// Copies the color, byte for byte, to an image of the output format and this size, whatever was
  /// in it, and leaves that in COLOR_ATTACHMENT_OPTIMAL, ready for an overlay.
  void copy_to(VkCommandBuffer commands, VkImage image) const;

 private:
  VkSampleCountFlagBits samples_;
  gpu::DeviceImage color_;
  gpu::DeviceImage multisampled_;
  gpu::DeviceImage depth_;
};

/// Records scenes. Pipelines are made when a setting first needs them and kept.
class Renderer {
 public:
  explicit Renderer(gpu::Device& device);
  ~Renderer();
  Renderer(const Renderer&) = delete;
  Renderer& operator=(const Renderer&) = delete;

  /// Records the whole scene into `target`. Pre: `mesh` has been applied with these settings;
  /// `settings.samples` is what `target` was made with or the device allowed.
  void draw(VkCommandBuffer commands, const SceneTarget& target, const GpuMesh& mesh,
            const Camera& camera, const Settings& settings);
  /// The same triangles in the same target with one constant color: what the hardware asks for at
  /// least. The bar for benchmarks.
  void draw_bare(VkCommandBuffer commands, const SceneTarget& target, const GpuMesh& mesh,
                 const Camera& camera);

 private:
  struct Pipelines;
  struct Pass;
  Pass begin(VkCommandBuffer commands, const SceneTarget& target, const GpuMesh& mesh,
             const Camera& camera, const Color& background);

  gpu::Device& device_;
  std::unique_ptr<Pipelines> pipelines_;
};

}  // namespace mesher::render
