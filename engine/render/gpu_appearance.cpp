#include "engine/render/gpu_appearance.h"

#include <cstring>
#include <span>

namespace mesher::render {

void GpuAppearance::update(const Mesh& mesh, const Settings& settings, const Appearance& appearance,
                           bool is_changed, UploadStats& stats) {
  look_ = drawn_look(settings, appearance.attributes, appearance.materials.get());
  if (look_ == Look::clay) {
    // Clay needs none of it, and other edits would make it outdated.
    if (is_changed) model_.reset();
    return;
  }
  const bool is_new = !model_;
  if (is_new) model_.emplace(device_);
  if (is_new || is_changed) {
    if (appearance.changes == nullptr || !model_->has_levels) {
      copy_all(appearance, stats);
    } else {
      model_->attributes.update(*appearance.attributes, *appearance.changes, appearance.morph,
                                stats);
    }
    model_->has_levels = appearance.changes != nullptr;
    if (appearance.changes != nullptr) appearance.changes->clear();
    model_->batches = batches_of_level(model_->order, mesh);
  }
  if (!materials_) materials_.emplace(device_);
  materials_->update(mesh, appearance, look_);
}

void GpuAppearance::copy_all(const Appearance& appearance, UploadStats& stats) {
  const Attributes& attributes = *appearance.attributes;
  model_->attributes.update(attributes, appearance.morph, stats);
  // The faces of coarser levels are the first ones of each batch.
  const std::uint32_t faces =
      attributes.group.empty() ? kNone : static_cast<std::uint32_t>(attributes.group.size());
  model_->order = order_of_faces(faces, attributes, appearance.materials.get());
  upload_whole(device_, model_->faces, std::as_bytes(std::span(model_->order.faces)), 0, stats);
}

void GpuAppearance::place(shared::SurfaceBlock block) {
  if (look_ == Look::clay) return;
  model_->attributes.describe(block);
  if (model_->placed && std::memcmp(&*model_->placed, &block, sizeof(block)) == 0) return;
  if (!model_->surface)
    model_->surface = gpu::Buffer(device_, sizeof(block), 0, gpu::MemoryIntent::fixed);
  gpu::upload(device_, model_->surface, std::as_bytes(std::span(&block, 1)));
  model_->placed = block;
}

}  // namespace mesher::render
