#pragma once

#include <array>
#include <span>

#include "engine/core/array.h"
#include "engine/mesh/mesh.h"

namespace mesher {

/// The part of a mesh under simplification that is still alive, so that collapses can be taken
/// back. It holds the mesh alone, not what is kept beside it (Surface): after `restore` the mesh
/// can be read, but not be simplified further. O(live) memory: about 56 bytes per face that is
/// left.
class Checkpoint {
 public:
  /// Copies all vertices of `live` and their faces. O(live). Pre: each vertex that has faces is in
  /// `live`.
  Checkpoint(const Mesh& mesh, std::span<const Vertex> live);

  /// Takes back all collapses since then; `live` becomes what it was. O(live). Pre: `mesh` is the
  /// same mesh, changed by collapses only.
  void restore(Mesh& mesh, Array<Vertex>& live) const;

 private:
  struct VertexCopy {
    Vertex v;
    Halfedge outgoing;
    glm::vec3 position;
    float sharpness;
  };
  struct FaceCopy {
    Face f;
    std::array<Vertex, 3> origin;
    std::array<Halfedge, 3> twin;
    std::array<float, 3> sharpness;
  };

  void copy_face(const Mesh& mesh, Face f);

  Array<VertexCopy> vertices_;
  Array<FaceCopy> faces_;
};

}  // namespace mesher
