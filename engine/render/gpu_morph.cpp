#include "engine/render/gpu_morph.h"

#include <array>

#include "engine/core/assert.h"

namespace mesher::render {

void GpuMorph::update(const Mesh& mesh, const Sources& sources, bool is_new_mesh,
                      UploadStats& stats) {
  const MorphSource& source = sources.morph;
  const bool has_normals = !sources.vertex_normals.empty();
  const bool is_new = is_new_mesh || is_empty() || source.splits.size() < split_count_ ||
                      (has_normals && !has_normals_);
  has_normals_ = has_normals;
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
    const std::size_t most = source.heads.size() + source.splits_to_come();
    make_room(device_, heads_, most * sizeof(std::uint32_t), 0);
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
    make_room(device_, splits_, splits.size_bytes(), 0);
    first = 0;
  }
  const std::array range{gpu::ByteRange{first * sizeof(SplitMorph), splits.size_bytes()}};
  gpu::upload(device_, splits_, std::as_bytes(splits), range);
  stats.uploaded_bytes += range.front().size();
  ++stats.ranges;
  split_count_ = static_cast<std::uint32_t>(splits.size());
}

}  // namespace mesher::render
