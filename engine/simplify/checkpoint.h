#pragma once

#include <array>
#include <span>

#include "engine/core/array.h"
#include "engine/mesh/mesh.h"

namespace mesher::simplify {

/// A copy of the live part of a mesh under simplification, from which collapses can be undone. It
/// copies the mesh alone, not the Surface data kept beside it: after `restore` the mesh can be read
/// but not simplified further. Memory: O(live), about 52 bytes per remaining face.
class Checkpoint {
 public:
  /// Copies all vertices of `live` and their faces. O(live). Pre: every vertex that has faces is in
  /// `live`.
  Checkpoint(const Mesh& mesh, std::span<const Vertex> live);

  /// Undoes all collapses since construction and resets `live`. O(live). Pre: `mesh` is the same
  /// mesh, changed by collapses only.
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

}  // namespace mesher::simplify
