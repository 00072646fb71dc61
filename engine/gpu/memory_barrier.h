#pragma once

#include <vulkan/vulkan.h>

namespace mesher::gpu {

/// Stages of a queue and what they do to memory.
struct MemoryUse {
  VkPipelineStageFlags2 stages = 0;
  VkAccessFlags2 access = 0;
};

/// What `before` did is finished, and its writes are seen by what `after` does from here on.
void memory_barrier(VkCommandBuffer commands, const MemoryUse& before, const MemoryUse& after);

}  // namespace mesher::gpu
