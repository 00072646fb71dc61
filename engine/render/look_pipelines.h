#pragma once

#include <map>

#include "engine/gpu/pipeline.h"
#include "engine/render/scene_target.h"
#include "engine/render/settings.h"

namespace mesher::render {

/// A way to draw the faces of a batch.
struct LookPass {
  Look look = Look::material;
  bool has_wire = false;  ///< with ordinary edges on the surface
  bool blends = false;
  bool morphs = false;  ///< vertices move during a geomorph
  friend auto operator<=>(const LookPass&, const LookPass&) = default;
};

/// The pipelines of surfaces with materials, each created on first use.
class LookPipelines {
 public:
  explicit LookPipelines(gpu::Device& device);

  VkPipelineLayout layout() const { return layout_.get(); }
  /// Returns a pipeline for `target`'s format and samples. Another kind of target drops the
  /// existing pipelines.
  VkPipeline get(const LookPass& pass, const SceneTarget& target);

 private:
  gpu::Device& device_;
  gpu::UniqueSetLayout set_layout_;
  gpu::UniquePipelineLayout layout_;
  std::map<LookPass, gpu::UniquePipeline> pipelines_;
  VkFormat format_ = VK_FORMAT_UNDEFINED;
  VkSampleCountFlagBits samples_ = VK_SAMPLE_COUNT_1_BIT;
};

}  // namespace mesher::render
