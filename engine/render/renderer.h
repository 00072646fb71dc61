#pragma once

#include "engine/render/camera.h"
#include "engine/render/geomorph_block.h"
#include "engine/render/gpu_mesh.h"
#include "engine/render/scene_pipelines.h"
#include "engine/render/scene_target.h"
#include "engine/render/settings.h"

namespace mesher::render {

/// Records scenes. Pipelines are made when a setting first needs them and kept.
///
/// The cost of a frame, for benchmarks: `device.run_once([&](auto commands) { renderer.draw(...);
/// })` submits and waits, so its wall time is the frame's.
class Renderer {
 public:
  explicit Renderer(gpu::Device& device) : pipelines_(device), geomorph_(device) {}

  /// Records the whole scene into `target`. Pre: `mesh` has been applied with these settings.
  /// Throws DeviceError where a pipeline cannot be made.
  void draw(VkCommandBuffer commands, const SceneTarget& target, const GpuMesh& mesh,
            const Camera& camera, const Settings& settings);
  /// The same triangles in the same target in one constant color: what any indexed draw has to
  /// cost.
  void draw_bare(VkCommandBuffer commands, const SceneTarget& target, const GpuMesh& mesh,
                 const Camera& camera, const Settings& settings);

 private:
  ScenePipelines pipelines_;
  GeomorphBlock geomorph_;
};

}  // namespace mesher::render
