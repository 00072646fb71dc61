#pragma once

#include <cstddef>
#include <cstdint>

#include "engine/gpu/buffer.h"
#include "engine/mesh/mesh.h"
#include "engine/render/sources.h"
#include "engine/render/upload.h"

namespace mesher::render {

/// The GPU's mirror of the data that moves vertices during a geomorph. Time is not part of it, so a
/// running geomorph uploads nothing.
class GpuMorph {
 public:
  explicit GpuMorph(gpu::Device& device) : device_(device) {}

  /// Copies the heads in `mesh.changes()` and the new splits; everything if the mesh is new;
  /// nothing (and no buffers) if the source is empty. Splits that arrive gradually are copied O(1)
  /// times each on average.
  void update(const Mesh& mesh, const Sources& sources, bool is_new_mesh, UploadStats& stats);

  bool is_empty() const { return split_count_ == 0; }
  std::uint32_t split_count() const { return split_count_; }
  const gpu::Buffer& heads() const { return heads_; }    ///< uint per vertex
  const gpu::Buffer& splits() const { return splits_; }  ///< SplitMorph, ten words each
  /// Sizes of the live parts of the buffers, in bytes.
  std::size_t head_bytes() const { return head_count_ * sizeof(std::uint32_t); }
  std::size_t split_bytes() const { return split_count_ * sizeof(SplitMorph); }

 private:
  void append_splits(std::span<const SplitMorph> splits, UploadStats& stats);

  gpu::Device& device_;
  bool has_normals_ = false;  ///< the normals of the splits are known
  std::uint32_t head_count_ = 0;
  std::uint32_t split_count_ = 0;
  gpu::Buffer heads_;
  gpu::Buffer splits_;
};

}  // namespace mesher::render
