#pragma once

#include <cstdint>
#include <map>
#include <string>

#include "engine/gpu/buffer.h"
#include "engine/mesh/attributes.h"
#include "engine/mesh/change_log.h"
#include "engine/mesh/geomorph.h"
#include "engine/render/upload.h"
#include "shaders/shared/look.h"

namespace mesher::render {

/// The GPU's mirror of a model's attributes: the layers that are drawn, and the wedges of the
/// corners, byte for byte.
class GpuAttributes {
 public:
  explicit GpuAttributes(gpu::Device& device) : device_(device) {}

  /// Copies all. Layers of a type that cannot be drawn are left out. Throws DeviceError.
  void update(const Attributes& attributes, const WedgeMorph& morph, UploadStats& stats);
  /// Copies what has changed of the attributes of the last update. Throws DeviceError.
  void update(const Attributes& attributes, const ChangeLog& changes, const WedgeMorph& morph,
              UploadStats& stats);
  /// Returns the size of all that is mirrored.
  std::size_t bytes() const;
  /// Sets the members that refer to attributes.
  void describe(shared::SurfaceBlock& block) const;

 private:
  struct Layer {
    gpu::Buffer buffer;
    shared::LayerConstants constants{};
    std::uint32_t first_word = 0;  ///< as in WedgeMorph
  };

  void describe(const std::string& name, shared::LayerConstants& layer,
                std::uint32_t& first_word) const;

  gpu::Device& device_;
  std::map<std::string, Layer> layers_;
  gpu::Buffer wedges_;
  gpu::Buffer heads_;                ///< of WedgeMorph
  gpu::Buffer changes_;              ///< its words
  std::uint32_t change_stride_ = 0;  ///< 0: attributes do not move
  bool has_seams_ = false;
  bool has_linear_colors_ = false;
};

}  // namespace mesher::render
