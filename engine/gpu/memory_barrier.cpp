#include "engine/gpu/memory_barrier.h"

namespace mesher::gpu {

void memory_barrier(VkCommandBuffer commands, const MemoryUse& before, const MemoryUse& after) {
  const VkMemoryBarrier2 barrier{.sType = VK_STRUCTURE_TYPE_MEMORY_BARRIER_2,
                                 .pNext = nullptr,
                                 .srcStageMask = before.stages,
                                 .srcAccessMask = before.access,
                                 .dstStageMask = after.stages,
                                 .dstAccessMask = after.access};
  VkDependencyInfo dependency{};
  dependency.sType = VK_STRUCTURE_TYPE_DEPENDENCY_INFO;
  dependency.memoryBarrierCount = 1;
  dependency.pMemoryBarriers = &barrier;
  vkCmdPipelineBarrier2(commands, &dependency);
}

}  // namespace mesher::gpu
