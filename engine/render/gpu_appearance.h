#pragma once

#include <optional>
#include <string>
#include <vector>

#include "engine/render/draw_order.h"
#include "engine/render/gpu_attributes.h"
#include "engine/render/gpu_materials.h"
#include "engine/render/look.h"

namespace mesher::render {

/// What the GPU needs to draw a mesh in another look than clay. For clay there is nothing.
class GpuAppearance {
 public:
  explicit GpuAppearance(gpu::Device& device) : device_(device) {}

  /// Updates all from the model. `is_changed`: positions, origins or attributes may differ from
  /// those of the last call. Throws DeviceError.
  void update(const Mesh& mesh, const Settings& settings, const Appearance& appearance,
              bool is_changed, UploadStats& stats);
  /// Makes the next update copy all attributes, even those of a level.
  void invalidate() {
    if (model_) model_->has_levels = false;
  }
  /// Returns the size of the attributes on the GPU.
  std::size_t attribute_bytes() const { return model_ ? model_->attributes.bytes() : 0; }
  /// Writes where the arrays of the mesh are, unless the last call did. Call it after `update`.
  void place(shared::SurfaceBlock block);

  /// The look of the last update. Clay: there is nothing else here, and only `problems` may be
  /// called.
  Look look() const { return look_; }
  VkDeviceAddress surface() const { return model_->surface.address(); }
  /// The faces in their order; 0: as in the mesh.
  VkDeviceAddress faces() const {
    return model_->order.faces.empty() ? 0 : model_->faces.address();
  }
  const std::vector<Batch>& batches() const { return model_->batches; }
  const GpuMaterials& materials() const { return *materials_; }
  /// What is not drawn of the model, a line for each.
  std::vector<std::string> problems() const {
    return look_ == Look::clay ? std::vector<std::string>{} : materials_->problems();
  }

 private:
  void copy_all(const Appearance& appearance, UploadStats& stats);

  struct ModelParts {
    explicit ModelParts(gpu::Device& device) : attributes(device) {}
    GpuAttributes attributes;
    bool has_levels = false;  ///< they are those of a progressive mesh
    DrawOrder order;          ///< of all faces that the attributes have
    gpu::Buffer faces;
    std::vector<Batch> batches;
    gpu::Buffer surface;
    std::optional<shared::SurfaceBlock> placed;  ///< content of `surface`
  };

  gpu::Device& device_;
  Look look_ = Look::clay;
  std::optional<ModelParts> model_;        ///< none until it is drawn
  std::optional<GpuMaterials> materials_;  ///< the same; kept while clay is drawn
};

}  // namespace mesher::render
