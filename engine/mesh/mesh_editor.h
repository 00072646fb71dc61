#pragma once

#include "engine/mesh/collapse.h"
#include "engine/mesh/mesh.h"

namespace mesher {

/// Single steps of edits on a mesh's arrays, each noted in its changes. Between steps invariants
/// may be broken; whoever strings steps together restores them. Internal to engine/mesh.
class MeshEditor {
 public:
  explicit MeshEditor(Mesh& mesh) : mesh_(mesh) {}
  const Mesh& mesh() const { return mesh_; }

  void set_twin(Halfedge h, Halfedge twin);
  void set_sharpness(Halfedge h, float sharpness);
  void set_outgoing(Vertex v, Halfedge h);
  /// Every half-edge out of `from` starts at `to`. O(valence).
  void move_fan(Vertex from, Vertex to);
  /// Makes outgoing(v) the start of the sweep that contains `spoke`: at a boundary its first
  /// half-edge. O(valence).
  void start_fan_at_boundary(Vertex v, Halfedge spoke);
  /// Moves the last vertex into the place of `v`, which no face uses any more. O(valence).
  CollapseResult::Move remove_vertex(Vertex v);
  /// Moves the last face into the place of `f`, which no twin or outgoing names any more. O(1).
  CollapseResult::Move remove_face(Face f);

 private:
  Mesh& mesh_;
};

}  // namespace mesher
