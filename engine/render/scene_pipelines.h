#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "engine/gpu/pipeline.h"
#include "engine/render/scene_target.h"

namespace mesher::render {

/// Every way the scene's triangles are drawn.
enum class Pass : std::uint8_t {
  bare,                 ///< one constant color: the benchmark's yardstick
  depth,                ///< depth alone
  flat,                 ///< indexed
  gouraud,              ///< indexed, a normal a vertex
  gouraud_corner,       ///< by half-edge, a normal a half-edge
  flat_wire,            ///< by half-edge, with ordinary edges
  gouraud_wire,         ///< by half-edge, with ordinary edges, a normal a vertex
  gouraud_corner_wire,  ///< the same, a normal a half-edge
  wire_hidden,          ///< ordinary edges alone, drawn by their faces, behind `depth`
  wire_visible,         ///< the same, not behind it
  edge_hidden,          ///< ordinary edges alone, as quads, behind `depth`
  edge_visible,         ///< the same, not behind it
  line_hidden,          ///< quads of crease and boundary edges, behind what is drawn
  line_visible,         ///< the same, not behind it
};
inline constexpr std::size_t kPassCount = 14;

/// Where its vertices are.
enum class Vertices : std::uint8_t {
  still,    ///< where the mesh has them
  morphed,  ///< where splits that grow have brought them, with a color each where that is wanted
};
inline constexpr std::size_t kVerticesCount = 2;

/// Whether a pass takes indexed vertices (positions, and normals where it is `gouraud`) or pulls
/// them by half-edge number.
bool is_indexed(Pass pass);

/// The pipelines, each made when first asked for: starting up costs only what is drawn.
class ScenePipelines {
 public:
  explicit ScenePipelines(gpu::Device& device);

  VkPipelineLayout layout() const { return layout_.get(); }
  /// For `target`'s format and samples; asking for another kind of target drops those made before.
  VkPipeline get(Pass pass, Vertices vertices, const SceneTarget& target);

 private:
  gpu::Device& device_;
  gpu::UniquePipelineLayout layout_;
  std::array<gpu::UniquePipeline, kPassCount * kVerticesCount> pipelines_;
  VkFormat format_ = VK_FORMAT_UNDEFINED;
  VkSampleCountFlagBits samples_ = VK_SAMPLE_COUNT_1_BIT;
};

}  // namespace mesher::render
