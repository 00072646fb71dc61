#include "engine/render/geomorph_block.h"

#include <algorithm>

#include "shaders/shared/constants.h"

namespace mesher::render {
namespace {

bool is_growing(const GpuMesh& mesh, const GeomorphTime& time) {
  if (time.first_growing >= mesh.morph().split_count()) return false;
  return time.rate != 0.0F || time.fixed < 1.0F;
}

shared::GeomorphConstants constants_of(const GpuMesh& mesh, const Settings& settings) {
  const GeomorphTime time =
      is_growing(mesh, settings.geomorph) ? settings.geomorph : GeomorphTime::done();
  // By the number that may come, so that a color stays while levels go up and down.
  const std::uint32_t all =
      mesh.vertex_count() - std::min(mesh.vertex_count(), settings.first_birth);
  const std::uint32_t births = mesh.morph().is_empty() ? all : mesh.morph().split_count();
  return {.positions = mesh.positions().address(),
          .heads = mesh.morph().heads().address(),
          .splits = mesh.morph().splits().address(),
          .first_head = time.first_growing < kNoHead / 2 ? 2 * time.first_growing : kNoHead,
          .whole = time.whole,
          .fraction = time.fraction,
          .rate = time.rate,
          .fixed_share = time.fixed,
          .first_birth = settings.first_birth,
          .birth_scale =
              settings.colors_births ? 1.0F / static_cast<float>(std::max(births, 1U)) : -1.0F,
          .unused = 0};
}

void barrier(VkCommandBuffer commands, VkPipelineStageFlags2 from, VkAccessFlags2 written,
             VkPipelineStageFlags2 to, VkAccessFlags2 access) {
  const VkMemoryBarrier2 memory{.sType = VK_STRUCTURE_TYPE_MEMORY_BARRIER_2,
                                .pNext = nullptr,
                                .srcStageMask = from,
                                .srcAccessMask = written,
                                .dstStageMask = to,
                                .dstAccessMask = access};
  VkDependencyInfo dependency{};
  dependency.sType = VK_STRUCTURE_TYPE_DEPENDENCY_INFO;
  dependency.memoryBarrierCount = 1;
  dependency.pMemoryBarriers = &memory;
  vkCmdPipelineBarrier2(commands, &dependency);
}

}  // namespace

bool needs_geomorph(const GpuMesh& mesh, const Settings& settings) {
  return settings.colors_births || is_growing(mesh, settings.geomorph);
}

VkDeviceAddress GeomorphBlock::write(VkCommandBuffer commands, const GpuMesh& mesh,
                                     const Settings& settings) {
  const shared::GeomorphConstants constants = constants_of(mesh, settings);
  if (!buffer_) {
    buffer_ = gpu::Buffer(device_, sizeof(constants), 0, gpu::MemoryIntent::fixed);
  }
  // Frames before, in whatever command buffer, have read it and written it.
  barrier(commands, VK_PIPELINE_STAGE_2_VERTEX_SHADER_BIT | VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT,
          VK_ACCESS_2_TRANSFER_WRITE_BIT, VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT,
          VK_ACCESS_2_TRANSFER_WRITE_BIT);
  vkCmdUpdateBuffer(commands, buffer_.handle(), 0, sizeof(constants), &constants);
  barrier(commands, VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT, VK_ACCESS_2_TRANSFER_WRITE_BIT,
          VK_PIPELINE_STAGE_2_VERTEX_SHADER_BIT, VK_ACCESS_2_SHADER_STORAGE_READ_BIT);
  return buffer_.address();
}

}  // namespace mesher::render
