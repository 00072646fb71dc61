#pragma once

#include <cstddef>
#include <cstdint>

#include "engine/gpu/buffer.h"
#include "engine/mesh/mesh.h"
#include "engine/render/sources.h"
#include "engine/render/upload.h"

namespace mesher::render {

/// The GPU's mirror of what moves a mesh's vertices while splits grow. Time is no part of it: a
/// geomorph that goes on uploads nothing.
class GpuMorph {
 public:
  explicit GpuMorph(gpu::Device& device) : device_(device) {}

  /// Copies the heads that `mesh.changes()` names and the splits that are new; all where the mesh
  /// is, nothing and no buffers where the source is empty. Splits that come bit by bit are copied
  /// O(1) times each on average.
  void update(const Mesh& mesh, const Sources& sources, bool is_new_mesh, UploadStats& stats);

  bool is_empty() const { return split_count_ == 0; }
  std::uint32_t split_count() const { return split_count_; }
  const gpu::Buffer& heads() const { return heads_; }    ///< uint a vertex
  const gpu::Buffer& splits() const { return splits_; }  ///< SplitMorph, ten words each
  /// How much of either buffer is live.
  std::size_t head_bytes() const { return head_count_ * sizeof(std::uint32_t); }
  std::size_t split_bytes() const { return split_count_ * sizeof(SplitMorph); }

 private:
  void append_splits(std::span<const SplitMorph> splits, UploadStats& stats);

  gpu::Device& device_;
  bool has_normals_ = false;  ///< those of the splits are known
  std::uint32_t head_count_ = 0;
  std::uint32_t split_count_ = 0;
  gpu::Buffer heads_;
  gpu::Buffer splits_;
};

}  // namespace mesher::render
