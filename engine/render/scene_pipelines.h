#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "engine/gpu/pipeline.h"
#include "engine/render/scene_target.h"

namespace mesher::render {

/// All ways to draw the scene's triangles.
enum class Pass : std::uint8_t {
  bare,                 ///< one constant color: the benchmark's reference
  depth,                ///< depth alone
  flat,                 ///< indexed
  gouraud,              ///< indexed, one normal per vertex
  gouraud_corner,       ///< by half-edge, one normal per half-edge
  flat_wire,            ///< by half-edge, with ordinary edges
  gouraud_wire,         ///< by half-edge, with ordinary edges, one normal per vertex
  gouraud_corner_wire,  ///< the same, one normal per half-edge
  wire_hidden,          ///< ordinary edges alone, drawn by their faces, behind `depth`
  wire_visible,         ///< the same, not behind it
  edge_hidden,          ///< ordinary edges alone, as quads, behind `depth`
  edge_visible,         ///< the same, not behind it
  line_hidden,          ///< quads of crease and boundary edges, behind what is drawn
  line_visible,         ///< the same, not behind it
};
inline constexpr std::size_t kPassCount = 14;

/// Source of vertex positions.
enum class Vertices : std::uint8_t {
  still,    ///< the mesh's positions
  morphed,  ///< moved by growing splits, and colored per vertex if requested
  posed,    ///< moved by the matrices of a palette
};
inline constexpr std::size_t kVerticesCount = 3;

/// Returns whether a pass takes indexed vertices (positions, and normals for `gouraud`) rather than
/// pulling them by half-edge index.
bool is_indexed(Pass pass);

/// Pipelines, each created on first use: startup pays only for what is drawn.
class ScenePipelines {
 public:
  explicit ScenePipelines(gpu::Device& device);

  VkPipelineLayout layout() const { return layout_.get(); }
  /// Returns a pipeline for `target`'s format and samples. Another kind of target drops the
  /// existing pipelines.
  VkPipeline get(Pass pass, Vertices vertices, const SceneTarget& target);

 private:
  gpu::Device& device_;
  gpu::UniquePipelineLayout layout_;
  std::array<gpu::UniquePipeline, kPassCount * kVerticesCount> pipelines_;
  VkFormat format_ = VK_FORMAT_UNDEFINED;
  VkSampleCountFlagBits samples_ = VK_SAMPLE_COUNT_1_BIT;
};

}  // namespace mesher::render
