#pragma once

#include <cstdint>

#include "engine/render/gpu_appearance.h"
#include "engine/render/look_pipelines.h"
#include "shaders/shared/look.h"

namespace mesher::render {

/// What is the same for all batches of a frame.
struct LookFrame {
  VkCommandBuffer commands = VK_NULL_HANDLE;
  const SceneTarget& target;
  const GpuAppearance& appearance;
  /// Those without batches: view and lines.
  shared::LookConstants constants;
  bool has_wire = false;
  std::uint32_t section = 0;  ///< Section::code
};

/// Records the draws of faces `first` to `first + count` in the order of drawing, which puts what
/// blends last and from back to front. Pre: the rendering has begun; the look is not clay.
void draw_look(LookPipelines& pipelines, const LookFrame& frame, std::uint32_t first,
               std::uint32_t count);

}  // namespace mesher::render
