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

/// The form of LayerConstants::format.
std::uint32_t format_of(const AttributeType& type) {
  return type.components | static_cast<std::uint32_t>(type.component) << 3U |
         (type.is_normalized ? 64U : 0U);
}

}  // namespace

void GpuAttributes::update(const Attributes& attributes, UploadStats& stats) {
  for (const std::string& name : drawn_layers()) {
    const AttributeLayer* source = attributes.find(name);
    if (source == nullptr || source->count() == 0) {
      layers_.erase(name);
      continue;
    }
    Layer& layer = layers_[name];
    // Shaders read whole words.
    make_room(device_, layer.buffer, (source->bytes().size() + 3) / 4 * 4, 0);
    upload_whole(device_, layer.buffer, source->bytes(), 0, stats);
    layer.constants = {.values = layer.buffer.address(),
                       .stride = static_cast<std::uint32_t>(source->type().value_bytes()),
                       .format = format_of(source->type())};
  }
  has_seams_ = attributes.has_seams();
  const AttributeLayer* color = attributes.find("COLOR_0");
  has_linear_colors_ = color != nullptr && color->type().is_linear;
  upload_whole(device_, wedges_, std::as_bytes(std::span(attributes.corner_wedge)), 0, stats);
}

shared::LayerConstants GpuAttributes::layer(const std::string& name) const {
  const auto found = layers_.find(name);
  return found == layers_.end() ? shared::LayerConstants{} : found->second.constants;
}

void GpuAttributes::describe(shared::SurfaceBlock& block) const {
  block.wedges = wedges_.address();
  block.flags |= has_seams_ ? shared::kHasSeams : 0;
  block.flags |= has_linear_colors_ ? shared::kLinearColors : 0;
  block.normal = layer("NORMAL");
  block.tangent = layer("TANGENT");
  block.color = layer("COLOR_0");
  for (std::uint32_t set = 0; set < shared::kTexcoordSets; ++set)
    block.texcoord[set] = layer(texcoord_type(set).name);
}

}  // namespace mesher::render
