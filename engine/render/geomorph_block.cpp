#include "engine/render/geomorph_block.h"

#include <algorithm>
#include <cmath>

#include "engine/gpu/memory_barrier.h"
#include "shaders/shared/constants.h"

namespace mesher::render {
namespace {

bool is_growing(const GpuMesh& mesh, const GeomorphTime& time) {
  if (time.first_growing >= mesh.morph().split_count()) return false;
  return time.rate != 0.0F || time.fixed < 1.0F;
}

/// Returns the inverse of the number of times that the vertices from `first` on double those
/// before. Counts all splits that may come, so that a color stays the same while levels change.
float split_order_scale(const GpuMesh& mesh, const Settings& settings) {
  const std::uint32_t first = settings.first_split_vertex;
  std::uint32_t splits = settings.colored_splits;
  if (splits == 0) splits = mesh.morph().split_count();
  const double all = splits == 0 ? mesh.vertex_count() : static_cast<double>(first) + splits;
  const double doublings = std::log2((all + 1.0) / (first + 1.0));
  return static_cast<float>(1.0 / std::max(doublings, 1e-3));
}

shared::GeomorphConstants constants_of(const GpuMesh& mesh, const Settings& settings) {
  const GeomorphTime time =
      is_growing(mesh, settings.geomorph) ? settings.geomorph : GeomorphTime::done();
  return {.positions = mesh.positions().address(),
          .heads = mesh.morph().heads().address(),
          .splits = mesh.morph().splits().address(),
          .first_head = time.first_growing < kNoHead / 2 ? 2 * time.first_growing : kNoHead,
          .whole = time.whole,
          .fraction = time.fraction,
          .rate = time.rate,
          .fixed_share = time.fixed,
          .first_split_vertex = settings.first_split_vertex,
          .split_order_scale =
              settings.colors_by_split_order ? split_order_scale(mesh, settings) : -1.0F,
          .unused = 0};
}

}  // namespace

bool needs_geomorph(const GpuMesh& mesh, const Settings& settings) {
  return settings.colors_by_split_order || is_growing(mesh, settings.geomorph);
}

VkDeviceAddress GeomorphBlock::write(VkCommandBuffer commands, const GpuMesh& mesh,
                                     const Settings& settings) {
  const shared::GeomorphConstants constants = constants_of(mesh, settings);
  if (!buffer_) {
    buffer_ = gpu::Buffer(device_, sizeof(constants), 0, gpu::MemoryIntent::fixed);
  }
  // Earlier frames, in any command buffer, have read and written the block.
  gpu::memory_barrier(commands,
                      {VK_PIPELINE_STAGE_2_VERTEX_SHADER_BIT | VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT,
                       VK_ACCESS_2_TRANSFER_WRITE_BIT},
                      {VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT, VK_ACCESS_2_TRANSFER_WRITE_BIT});
  vkCmdUpdateBuffer(commands, buffer_.handle(), 0, sizeof(constants), &constants);
  gpu::memory_barrier(commands,
                      {VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT, VK_ACCESS_2_TRANSFER_WRITE_BIT},
                      {VK_PIPELINE_STAGE_2_VERTEX_SHADER_BIT, VK_ACCESS_2_SHADER_STORAGE_READ_BIT});
  return buffer_.address();
}

}  // namespace mesher::render
