#pragma once

#include <cstdint>

#include "engine/render/camera.h"
#include "engine/render/geomorph_block.h"
#include "engine/render/gpu_mesh.h"
#include "engine/render/look_pipelines.h"
#include "engine/render/scene_pipelines.h"
#include "engine/render/scene_target.h"
#include "engine/render/section.h"
#include "engine/render/settings.h"

namespace mesher::render {

/// A part of the work of drawing a scene: triangles `begin` to `end`, counted over all passes.
struct WorkRange {
  std::uint64_t begin = 0;
  std::uint64_t end = 0;
};

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
        look_pipelines_(device),
        geomorph_(device) {}

  /// Records the whole scene into `target`. Pre: `mesh` has been applied with these settings.
  /// Throws DeviceError if a pipeline cannot be created.
  void draw(VkCommandBuffer commands, const SceneTarget& target, const GpuMesh& mesh,
            const Camera& camera, const Settings& settings);
  /// Records one part of a picture that may be larger than the target. Pre: as for section_of.
  void draw(VkCommandBuffer commands, const SceneTarget& target, const GpuMesh& mesh,
            const Camera& camera, const Settings& settings, const PicturePart& part);
  /// Records a part of the work of drawing the scene, so that a scene that takes long can be drawn
  /// in several command buffers, with frames in between. The slices have to be drawn in order, with
  /// the same arguments otherwise; after the last one, the target is the same, bit by bit, as after
  /// one `draw`. Pre: slice.begin < slice.end.
  void draw_slice(VkCommandBuffer commands, const SceneTarget& target, const GpuMesh& mesh,
                  const Camera& camera, const Settings& settings, const WorkRange& slice);
  /// The same for one part of a picture.
  void draw_slice(VkCommandBuffer commands, const SceneTarget& target, const GpuMesh& mesh,
                  const Camera& camera, const Settings& settings, const WorkRange& slice,
                  const PicturePart& part);
  /// Returns the work of drawing the scene, in triangles, which is the end of the last slice; at
  /// least 1.
  static std::uint64_t work(const GpuMesh& mesh, const Settings& settings);
  /// Records the same triangles into the same target in one constant color: the minimum cost of any
  /// indexed draw.
  void draw_bare(VkCommandBuffer commands, const SceneTarget& target, const GpuMesh& mesh,
                 const Camera& camera, const Settings& settings);

 private:
  VkExtent2D largest_viewport_;
  ScenePipelines pipelines_;
  LookPipelines look_pipelines_;
  GeomorphBlock geomorph_;
};

}  // namespace mesher::render
