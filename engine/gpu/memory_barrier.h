#pragma once

#include <vulkan/vulkan.h>

namespace mesher::gpu {

/// Pipeline stages and their memory accesses.
struct MemoryUse {
  VkPipelineStageFlags2 stages = 0;
  VkAccessFlags2 access = 0;
};

/// Records a barrier: `before` completes, and its writes are visible to `after`.
void memory_barrier(VkCommandBuffer commands, const MemoryUse& before, const MemoryUse& after);

}  // namespace mesher::gpu
