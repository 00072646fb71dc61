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
  /// another mesh (GpuMesh::invalidate). Their normals count only beside Sources::vertex_normals,
  /// and may be others after a time without those: while splits still arrive nobody knows them.
  std::span<const SplitMorph> splits;

  bool is_empty() const { return heads.empty() || splits.empty(); }
  /// How many splits come after the level that the heads are of: the last vertex's head is its
  /// birth.
  std::size_t splits_to_come() const {
    if (is_empty()) return 0;
    return splits.size() - (heads.back() == kNoHead ? 0 : heads.back() / 2 + std::size_t{1});
  }
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
