#pragma once

#include "engine/gpu/buffer.h"
#include "engine/render/gpu_mesh.h"
#include "engine/render/settings.h"

namespace mesher::render {

/// Whether vertices have to be moved or colored: otherwise a frame costs what it always did.
bool needs_geomorph(const GpuMesh& mesh, const Settings& settings);

/// The block of GeomorphConstants that the MORPH variants of shaders read in a frame.
class GeomorphBlock {
 public:
  explicit GeomorphBlock(gpu::Device& device) : device_(device) {}

  /// Records that the block holds what `settings` say of `mesh`, for what is drawn after, and gives
  /// its address. Frames before it still find theirs. Pre: not within rendering.
  VkDeviceAddress write(VkCommandBuffer commands, const GpuMesh& mesh, const Settings& settings);

 private:
  gpu::Device& device_;
  gpu::Buffer buffer_;
};

}  // namespace mesher::render
