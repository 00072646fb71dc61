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
      model_->attributes.update(*appearance.attributes, appearance.morph, stats);
    } else {
      model_->attributes.update(*appearance.attributes, *appearance.changes, appearance.morph,
                                stats);
    }
    model_->has_levels = appearance.changes != nullptr;
    if (appearance.changes != nullptr) appearance.changes->clear();
    DrawOrder order = draw_order(mesh, *appearance.attributes, appearance.materials.get());
    model_->has_order = !order.faces.empty();
    upload_whole(device_, model_->faces, std::as_bytes(std::span(order.faces)), 0, stats);
    model_->batches = std::move(order.batches);
  }
  if (!materials_) materials_.emplace(device_);
  materials_->update(mesh, appearance, look_);
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
