#pragma once

#include <cstdint>
#include <glm/mat4x4.hpp>
#include <vector>

#include "engine/core/progress.h"
#include "engine/io/gltf_file.h"

namespace mesher::io {

/// A node of the default scene.
struct PlacedNode {
  std::uint64_t node;
  glm::dmat4 to_world;
};

/// Returns the nodes of the default scene depth first, in file order. A document without scenes
/// shows all its nodes. O(nodes), however deep they are nested. Throws InputError if the nodes do
/// not form a tree; Cancelled.
std::vector<PlacedNode> placed_nodes(const GltfFile& gltf, const Progress* progress);

}  // namespace mesher::io
