#include "engine/render/gpu_pose.h"

#include <algorithm>
#include <cstring>
#include <span>

#include "engine/core/assert.h"

namespace mesher::render {

void GpuPose::update(const Mesh& mesh, const PoseSource& source, VkDeviceAddress positions,
                     bool is_changed, UploadStats& stats) {
  if (source.is_empty() || mesh.vertex_count() == 0) {
    influences_ = {};
    palette_ = {};
    palette_content_.clear();
    block_ = {};
    constants_ = {};
    placed_.reset();
    return;
  }
  MESHER_ASSERT(source.influences.size() % mesh.vertex_count() == 0);
  if (is_changed || is_empty())
    upload_whole(device_, influences_, std::as_bytes(source.influences), 0, stats);
  if (!std::ranges::equal(source.palette, palette_content_)) {
    upload_whole(device_, palette_, std::as_bytes(source.palette), 0, stats);
    palette_content_.assign(source.palette.begin(), source.palette.end());
  }
  box_ = source.box;
  constants_ = {
      .positions = positions,
      .influences = influences_.address(),
      .palette = palette_.address(),
      .per_vertex = static_cast<std::uint32_t>(source.influences.size() / mesh.vertex_count()),
      .unused = 0};
  if (placed_ && std::memcmp(&*placed_, &constants_, sizeof(constants_)) == 0) return;
  if (!block_) block_ = gpu::Buffer(device_, sizeof(constants_), 0, gpu::MemoryIntent::fixed);
  gpu::upload(device_, block_, std::as_bytes(std::span(&constants_, 1)));
  placed_ = constants_;
}

}  // namespace mesher::render
