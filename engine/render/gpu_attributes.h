#pragma once

#include <cstdint>
#include <map>
#include <string>

#include "engine/gpu/buffer.h"
#include "engine/mesh/attributes.h"
#include "engine/render/upload.h"
#include "shaders/shared/look.h"

namespace mesher::render {

/// The GPU's mirror of a model's attributes: the layers that are drawn, and the wedges of the
/// corners, byte for byte.
class GpuAttributes {
 public:
  explicit GpuAttributes(gpu::Device& device) : device_(device) {}

  /// Copies all. Layers of a type that cannot be drawn are left out. Throws DeviceError.
  void update(const Attributes& attributes, UploadStats& stats);
  /// Sets the members that refer to attributes.
  void describe(shared::SurfaceBlock& block) const;

 private:
  struct Layer {
    gpu::Buffer buffer;
    shared::LayerConstants constants{};
  };

  shared::LayerConstants layer(const std::string& name) const;

  gpu::Device& device_;
  std::map<std::string, Layer> layers_;
  gpu::Buffer wedges_;
  bool has_seams_ = false;
  bool has_linear_colors_ = false;
};

}  // namespace mesher::render
