#include "engine/render/look_pipelines.h"

#include "engine/gpu/texture.h"
#include "engine/render/shaders.h"
#include "shaders/shared/look.h"

namespace mesher::render {
namespace {

shaders::Words vertex_shader(const LookPass& pass) {
  if (pass.morphs) return pass.has_wire ? shaders::kLookMorphWireVert : shaders::kLookMorphVert;
  return pass.has_wire ? shaders::kLookWireVert : shaders::kLookVert;
}

shaders::Words fragment_shader(const LookPass& pass) {
  switch (pass.look) {
    case Look::base_color:
      return pass.has_wire ? shaders::kBaseColorWireFrag : shaders::kBaseColorFrag;
    case Look::normals:
      return pass.has_wire ? shaders::kNormalsWireFrag : shaders::kNormalsFrag;
    case Look::uv_checker:
      return pass.has_wire ? shaders::kCheckerWireFrag : shaders::kCheckerFrag;
    case Look::automatic:
    case Look::material:
    case Look::clay:
      break;
  }
  return pass.has_wire ? shaders::kMaterialWireFrag : shaders::kMaterialFrag;
}

}  // namespace

LookPipelines::LookPipelines(gpu::Device& device)
    : device_(device),
      set_layout_(gpu::create_texture_layout(device, shared::kTextureCount)),
      layout_(gpu::create_layout(device, sizeof(shared::LookConstants), set_layout_.get())) {}

VkPipeline LookPipelines::get(const LookPass& pass, const SceneTarget& target) {
  if (target.format() != format_ || target.samples() != samples_) {
    pipelines_.clear();
    format_ = target.format();
    samples_ = target.samples();
  }
  gpu::UniquePipeline& pipeline = pipelines_[pass];
  if (!pipeline) {
    gpu::PipelineOptions options;
    options.vertex_shader = vertex_shader(pass);
    options.fragment_shader = fragment_shader(pass);
    options.color_format = format_;
    options.depth_format = SceneTarget::kDepthFormat;
    options.samples = samples_;
    options.blends = pass.blends;
    options.writes_depth = !pass.blends;
    options.may_cull = true;
    pipeline = gpu::create_pipeline(device_, layout_.get(), options);
  }
  return pipeline.get();
}

}  // namespace mesher::render
