#pragma once

#include "engine/gpu/buffer.h"
#include "engine/render/gpu_mesh.h"
#include "engine/render/settings.h"

namespace mesher::render {

/// Returns whether vertices must be moved or colored. If not, a frame costs no more than without
/// geomorphs.
bool needs_geomorph(const GpuMesh& mesh, const Settings& settings);

/// The block of GeomorphConstants that the MORPH shader variants read in a frame.
class GeomorphBlock {
 public:
  explicit GeomorphBlock(gpu::Device& device) : device_(device) {}

  /// Records the update of the block from `settings` and `mesh` for the following draws, and
  /// returns its address. Earlier frames still read their own values. Pre: outside a render pass.
  VkDeviceAddress write(VkCommandBuffer commands, const GpuMesh& mesh, const Settings& settings);

 private:
  gpu::Device& device_;
  gpu::Buffer buffer_;
};

}  // namespace mesher::render
