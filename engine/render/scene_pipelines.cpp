#include "engine/render/scene_pipelines.h"

#include "engine/render/shaders.h"
#include "shaders/shared/constants.h"

namespace mesher::render {
namespace {

constexpr std::array kPosition{VK_FORMAT_R32G32B32_SFLOAT};
constexpr std::array kPositionAndNormal{VK_FORMAT_R32G32B32_SFLOAT, VK_FORMAT_R16G16_SNORM};

struct PassShaders {
  shaders::Words vertex;
  shaders::Words fragment;
};

PassShaders shaders_of(Pass pass) {
  switch (pass) {
    case Pass::bare:
      return {shaders::kBareVert, shaders::kBareFrag};
    case Pass::depth:
      return {shaders::kFlatVert, {}};
    case Pass::flat:
      return {shaders::kFlatVert, shaders::kFlatFrag};
    case Pass::gouraud:
      return {shaders::kGouraudVert, shaders::kGouraudFrag};
    case Pass::gouraud_corner:
      return {shaders::kGouraudCornerVert, shaders::kGouraudFrag};
    case Pass::flat_wire:
      return {shaders::kFlatPulledVert, shaders::kFlatWireFrag};
    case Pass::gouraud_wire:
      return {shaders::kGouraudPulledVert, shaders::kGouraudWireFrag};
    case Pass::gouraud_corner_wire:
      return {shaders::kGouraudCornerVert, shaders::kGouraudWireFrag};
    case Pass::wire_hidden:
    case Pass::wire_visible:
      return {shaders::kFlatPulledVert, shaders::kWireAloneFrag};
    case Pass::edge_hidden:
    case Pass::edge_visible:
      return {shaders::kEdgeVert, shaders::kLineFrag};
    case Pass::line_hidden:
    case Pass::line_visible:
      return {shaders::kLineVert, shaders::kLineFrag};
  }
  return {};
}

PassShaders morphed_shaders_of(Pass pass) {
  switch (pass) {
    case Pass::bare:
      break;  // the reference stays unchanged
    case Pass::depth:
      return {shaders::kFlatMorphVert, {}};
    case Pass::flat:
      return {shaders::kFlatMorphVert, shaders::kFlatTintFrag};
    case Pass::gouraud:
      return {shaders::kGouraudMorphVert, shaders::kGouraudTintFrag};
    case Pass::gouraud_corner:
      return {shaders::kGouraudCornerMorphVert, shaders::kGouraudTintFrag};
    case Pass::flat_wire:
      return {shaders::kFlatPulledMorphVert, shaders::kFlatWireTintFrag};
    case Pass::gouraud_wire:
      return {shaders::kGouraudPulledMorphVert, shaders::kGouraudWireTintFrag};
    case Pass::gouraud_corner_wire:
      return {shaders::kGouraudCornerMorphVert, shaders::kGouraudWireTintFrag};
    case Pass::wire_hidden:
    case Pass::wire_visible:
      return {shaders::kFlatPulledMorphVert, shaders::kWireAloneFrag};
    case Pass::edge_hidden:
    case Pass::edge_visible:
      return {shaders::kEdgeMorphVert, shaders::kLineFrag};
    case Pass::line_hidden:
    case Pass::line_visible:
      return {shaders::kLineMorphVert, shaders::kLineFrag};
  }
  return shaders_of(pass);
}

PassShaders posed_shaders_of(Pass pass) {
  PassShaders code = shaders_of(pass);
  switch (pass) {
    case Pass::bare:
      break;  // the reference stays unchanged
    case Pass::depth:
    case Pass::flat:
      code.vertex = shaders::kFlatPosedVert;
      break;
    case Pass::gouraud:
      code.vertex = shaders::kGouraudPosedVert;
      break;
    case Pass::gouraud_corner:
    case Pass::gouraud_corner_wire:
      code.vertex = shaders::kGouraudCornerPosedVert;
      break;
    case Pass::flat_wire:
    case Pass::wire_hidden:
    case Pass::wire_visible:
      code.vertex = shaders::kFlatPulledPosedVert;
      break;
    case Pass::gouraud_wire:
      code.vertex = shaders::kGouraudPulledPosedVert;
      break;
    case Pass::edge_hidden:
    case Pass::edge_visible:
      code.vertex = shaders::kEdgePosedVert;
      break;
    case Pass::line_hidden:
    case Pass::line_visible:
      code.vertex = shaders::kLinePosedVert;
      break;
  }
  return code;
}

PassShaders shaders_of(Pass pass, Vertices vertices) {
  switch (vertices) {
    case Vertices::still:
      break;
    case Vertices::morphed:
      return morphed_shaders_of(pass);
    case Vertices::posed:
      return posed_shaders_of(pass);
  }
  return shaders_of(pass);
}

gpu::PipelineOptions options_of(Pass pass, Vertices vertices) {
  const PassShaders code = shaders_of(pass, vertices);
  gpu::PipelineOptions options;
  options.vertex_shader = code.vertex;
  options.fragment_shader = code.fragment;
  if (pass == Pass::gouraud) {
    options.vertex_arrays = kPositionAndNormal;
  } else if (is_indexed(pass)) {
    options.vertex_arrays = kPosition;
  }
  switch (pass) {
    case Pass::wire_hidden:
    case Pass::edge_hidden:
    case Pass::line_hidden:
      options.depth_test = VK_COMPARE_OP_LESS;
      [[fallthrough]];
    case Pass::wire_visible:
    case Pass::edge_visible:
    case Pass::line_visible:
      options.blends = true;
      options.writes_depth = false;
      break;
    case Pass::bare:
    case Pass::depth:
    case Pass::flat:
    case Pass::gouraud:
    case Pass::gouraud_corner:
    case Pass::flat_wire:
    case Pass::gouraud_wire:
    case Pass::gouraud_corner_wire:
      break;
  }
  return options;
}

}  // namespace

bool is_indexed(Pass pass) {
  return pass == Pass::bare || pass == Pass::depth || pass == Pass::flat || pass == Pass::gouraud;
}

ScenePipelines::ScenePipelines(gpu::Device& device)
    : device_(device), layout_(gpu::create_layout(device, sizeof(shared::SurfaceConstants))) {}

VkPipeline ScenePipelines::get(Pass pass, Vertices vertices, const SceneTarget& target) {
  if (target.format() != format_ || target.samples() != samples_) {
    for (gpu::UniquePipeline& pipeline : pipelines_)
      pipeline.reset();
    format_ = target.format();
    samples_ = target.samples();
  }
  gpu::UniquePipeline& pipeline = pipelines_[kVerticesCount * static_cast<std::size_t>(pass) +
                                             static_cast<std::size_t>(vertices)];
  if (!pipeline) {
    gpu::PipelineOptions options = options_of(pass, vertices);
    options.color_format = format_;
    options.depth_format = SceneTarget::kDepthFormat;
    options.samples = samples_;
    pipeline = gpu::create_pipeline(device_, layout_.get(), options);
  }
  return pipeline.get();
}

}  // namespace mesher::render
