#pragma once

#include <glm/vec4.hpp>
#include <optional>
#include <vector>

#include "engine/gpu/buffer.h"
#include "engine/mesh/mesh.h"
#include "engine/render/sources.h"
#include "engine/render/upload.h"
#include "shaders/shared/constants.h"

namespace mesher::render {

/// The GPU's mirror of the data that poses vertices. A new pose uploads the palette alone.
class GpuPose {
 public:
  explicit GpuPose(gpu::Device& device) : device_(device) {}

  /// Copies the palette, and the influences if the mesh `is_changed`. Without a source there are no
  /// buffers. `positions`: address of those of the mesh. Throws DeviceError.
  void update(const Mesh& mesh, const PoseSource& source, VkDeviceAddress positions,
              bool is_changed, UploadStats& stats);

  bool is_empty() const { return constants_.per_vertex == 0; }
  /// Where the arrays are, for the POSED shader variants. Pre: not empty.
  VkDeviceAddress block() const { return block_.address(); }
  const shared::PoseConstants& constants() const { return constants_; }
  const Box& box() const { return box_; }

 private:
  gpu::Device& device_;
  gpu::Buffer influences_;
  gpu::Buffer palette_;
  gpu::Buffer block_;
  shared::PoseConstants constants_{};
  std::optional<shared::PoseConstants> placed_;  ///< content of `block_`
  std::vector<glm::vec4> palette_content_;
  Box box_;
};

}  // namespace mesher::render
