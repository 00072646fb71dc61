#include "engine/render/gpu_attributes.h"

#include <vector>

namespace mesher::render {
namespace {

/// The names of all layers that shaders read.
std::vector<std::string> drawn_layers() {
  std::vector<std::string> names{"NORMAL", "TANGENT", "COLOR_0"};
  for (std::uint32_t set = 0; set < shared::kTexcoordSets; ++set)
    names.push_back(texcoord_type(set).name);
  return names;
}

/// Returns whether a layer has the numbers that shaders read of its kind.
bool is_drawable(const AttributeType& type) {
  const std::uint32_t count = type.components;
  if (type.name == "NORMAL") return count == 3;
  if (type.name == "TANGENT") return count == 4;
  return type.name == "COLOR_0" ? count >= 3 : count == 2;
}

/// The form of LayerConstants::format.
std::uint32_t format_of(const AttributeType& type) {
  return type.components | static_cast<std::uint32_t>(type.component) << 3U |
         (type.is_normalized ? 64U : 0U);
}

}  // namespace

void GpuAttributes::update(const Attributes& attributes, const WedgeMorph& morph,
                           UploadStats& stats) {
  for (const std::string& name : drawn_layers()) {
    const AttributeLayer* source = attributes.find(name);
    if (source == nullptr || source->count() == 0 || !is_drawable(source->type())) {
      layers_.erase(name);
      continue;
    }
    Layer& layer = layers_[name];
    // Shaders read whole words.
    make_room(device_, layer.buffer, (source->bytes().size() + 3) / 4 * 4, 0);
    upload_whole(device_, layer.buffer, source->bytes(), 0, stats);
    const auto index = static_cast<std::size_t>(source - attributes.layers.data());
    layer.first_word = morph.is_empty() ? 0 : morph.first_word[index];
    layer.constants = {.values = layer.buffer.address(),
                       .stride = static_cast<std::uint32_t>(source->type().value_bytes()),
                       .format = format_of(source->type())};
  }
  has_seams_ = attributes.has_seams();
  const AttributeLayer* color = attributes.find("COLOR_0");
  has_linear_colors_ = color != nullptr && color->type().is_linear;
  upload_whole(device_, wedges_, std::as_bytes(std::span(attributes.corner_wedge)), 0, stats);
  change_stride_ = morph.is_empty() ? 0 : morph.stride;
  upload_whole(device_, heads_, std::as_bytes(morph.heads), 0, stats);
  upload_whole(device_, changes_, std::as_bytes(morph.words), 0, stats);
}

void GpuAttributes::update(const Attributes& attributes, const ChangeLog& changes,
                           const WedgeMorph& morph, UploadStats& stats) {
  for (auto& [name, layer] : layers_) {
    const AttributeLayer& source = *attributes.find(name);
    upload_changes(device_, layer.buffer, source.bytes(),
                   {changes, GpuArray::wedge_value, source.type().value_bytes()}, 0, stats);
  }
  upload_changes(device_, wedges_, std::as_bytes(std::span(attributes.corner_wedge)),
                 {changes, GpuArray::corner_wedge, sizeof(Wedge)}, 0, stats);
  if (change_stride_ > 0) {
    upload_changes(device_, heads_, std::as_bytes(morph.heads),
                   {changes, GpuArray::wedge_value, sizeof(std::uint32_t)}, 0, stats);
  }
}

std::size_t GpuAttributes::bytes() const {
  std::size_t sum = wedges_.size() + heads_.size() + changes_.size();
  for (const auto& [name, layer] : layers_)
    sum += layer.buffer.size();
  return sum;
}

void GpuAttributes::describe(const std::string& name, shared::LayerConstants& layer,
                             std::uint32_t& first_word) const {
  const auto found = layers_.find(name);
  if (found == layers_.end()) return;
  layer = found->second.constants;
  first_word = found->second.first_word;
}

void GpuAttributes::describe(shared::SurfaceBlock& block) const {
  block.wedges = wedges_.address();
  block.flags |= has_seams_ ? shared::kHasSeams : 0;
  block.flags |= has_linear_colors_ ? shared::kLinearColors : 0;
  block.change_stride = change_stride_;
  block.change_heads = heads_.address();
  block.changes = changes_.address();
  describe("NORMAL", block.normal, block.normal_change);
  describe("TANGENT", block.tangent, block.tangent_change);
  describe("COLOR_0", block.color, block.color_change);
  for (std::uint32_t set = 0; set < shared::kTexcoordSets; ++set)
    describe(texcoord_type(set).name, block.texcoord[set], block.texcoord_change[set]);
}

}  // namespace mesher::render
