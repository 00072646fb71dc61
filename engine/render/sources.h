#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <span>

#include "engine/mesh/geomorph.h"

namespace mesher::render {

/// What a mesh is drawn with while splits grow: see SplitMorph.
struct MorphSource {
  /// One a vertex. One may differ from that of the last time only where the mesh's log says that
  /// the vertex's position has changed.
  std::span<const std::uint32_t> heads;
  /// Those from the last time stay as they are; more may have come after them. Otherwise it is
  /// another mesh (GpuMesh::invalidate).
  std::span<const SplitMorph> splits;

  bool is_empty() const { return heads.empty() || splits.empty(); }
};

/// What a mirror takes beside the mesh. Each may be empty.
struct Sources {
  /// One a half-edge: taken for Gouraud shading instead of the faces'. They may change only with
  /// the mesh.
  std::span<const glm::vec3> corner_normals;
  /// One a vertex, as encode_normal gives them: taken before all others, and never split, whatever
  /// creases there are. They may change as heads may.
  std::span<const std::uint32_t> vertex_normals;
  MorphSource morph;
};

}  // namespace mesher::render
