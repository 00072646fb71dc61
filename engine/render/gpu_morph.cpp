#include "engine/render/gpu_morph.h"

#include <algorithm>
#include <array>

#include "engine/core/assert.h"

namespace mesher::render {

void GpuMorph::update(const Mesh& mesh, const MorphSource& source, bool is_new_mesh,
                      UploadStats& stats) {
  const bool is_new = is_new_mesh || is_empty() || source.splits.size() < split_count_;
  if (source.is_empty() || is_new) {
    heads_ = {};
    splits_ = {};
    head_count_ = 0;
    split_count_ = 0;
  }
  if (source.is_empty()) return;
  MESHER_ASSERT(source.heads.size() == mesh.vertex_count());
  const auto heads = std::as_bytes(source.heads);
  if (is_new) {
    upload_whole(device_, heads_, heads, 0, stats);
  } else {
    upload_changes(device_, heads_, heads,
                   {mesh.changes(), GpuArray::position, sizeof(std::uint32_t)}, 0, stats);
  }
  head_count_ = mesh.vertex_count();
  append_splits(source.splits, stats);
}

void GpuMorph::append_splits(std::span<const SplitMorph> splits, UploadStats& stats) {
  if (splits.size() == split_count_) return;
  std::size_t first = split_count_;
  if (splits_.size() < splits.size_bytes()) {
    // The first time just what is needed: most meshes come whole.
    const std::size_t room = first == 0 ? splits.size() : std::max(2 * first, splits.size());
    splits_ = gpu::Buffer(device_, room * sizeof(SplitMorph), 0, gpu::MemoryIntent::fixed);
    first = 0;
  }
  const std::array range{gpu::ByteRange{first * sizeof(SplitMorph), splits.size_bytes()}};
  gpu::upload(device_, splits_, std::as_bytes(splits), range);
  stats.uploaded_bytes += range.front().size();
  ++stats.ranges;
  split_count_ = static_cast<std::uint32_t>(splits.size());
}

}  // namespace mesher::render
