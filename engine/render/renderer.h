#pragma once

#include "engine/render/camera.h"
#include "engine/render/geomorph_block.h"
#include "engine/render/gpu_mesh.h"
#include "engine/render/scene_pipelines.h"
#include "engine/render/scene_target.h"
#include "engine/render/section.h"
#include "engine/render/settings.h"

namespace mesher::render {

/// Records scenes. Pipelines are created when first needed, and kept.
///
/// To measure a frame in benchmarks, call `device.run_once([&](auto commands) { renderer.draw(...);
/// })`. It submits and waits, so its wall time is the frame's cost.
class Renderer {
 public:
  explicit Renderer(gpu::Device& device)
      : largest_viewport_{device.properties().limits.maxViewportDimensions[0],
                          device.properties().limits.maxViewportDimensions[1]},
        pipelines_(device),
        geomorph_(device) {}

  /// Records the whole scene into `target`. Pre: `mesh` has been applied with these settings.
  /// Throws DeviceError if a pipeline cannot be created.
  void draw(VkCommandBuffer commands, const SceneTarget& target, const GpuMesh& mesh,
            const Camera& camera, const Settings& settings);
  /// Records one part of a picture that may be larger than the target. Pre: as for section_of.
  void draw(VkCommandBuffer commands, const SceneTarget& target, const GpuMesh& mesh,
            const Camera& camera, const Settings& settings, const PicturePart& part);
  /// Records the same triangles into the same target in one constant color: the minimum cost of any
  /// indexed draw.
  void draw_bare(VkCommandBuffer commands, const SceneTarget& target, const GpuMesh& mesh,
                 const Camera& camera, const Settings& settings);

 private:
  VkExtent2D largest_viewport_;
  ScenePipelines pipelines_;
  GeomorphBlock geomorph_;
};

}  // namespace mesher::render
