#pragma once

#include "engine/mesh/collapse.h"
#include "engine/mesh/mesh.h"

namespace mesher {

/// Single steps of edits on a mesh's arrays, each noted in its changes. Between steps invariants
/// may be broken; whoever strings steps together restores them. For engine/mesh and for
/// simplification in bulk, which closes the holes at the end instead of after each collapse.
class MeshEditor {
 public:
  explicit MeshEditor(Mesh& mesh) : mesh_(mesh) {}
  const Mesh& mesh() const { return mesh_; }

  void set_twin(Halfedge h, Halfedge twin) {
    mesh_.twin_[h.index()] = twin;
    mesh_.changes_.note(GpuArray::edge_class, h.index());
  }
  void set_sharpness(Halfedge h, float sharpness) {
    if (mesh_.sharpness_[h.index()] == sharpness) return;
    mesh_.sharpness_[h.index()] = sharpness;
    mesh_.changes_.note(GpuArray::edge_class, h.index());
  }
  void set_outgoing(Vertex v, Halfedge h) { mesh_.outgoing_[v.index()] = h; }
  void set_origin(Halfedge h, Vertex v) {
    mesh_.origin_[h.index()] = v;
    mesh_.changes_.note(GpuArray::origin, h.index());
  }
  /// Every half-edge out of `from` starts at `to`. O(valence).
  void move_fan(Vertex from, Vertex to);
  /// Makes outgoing(v) the start of the sweep that contains `spoke`: at a boundary its first
  /// half-edge. O(valence).
  void start_fan_at_boundary(Vertex v, Halfedge spoke);
  /// Of two edges that will fall together when the edge of `h` is merged, both get the larger
  /// sharpness. O(1).
  void join_sharpness(Halfedge h);
  /// Takes the one or two faces at the edge of `h` out of everything that names them; their own
  /// entries stay behind as holes. Sharpness (`join_sharpness`, before) and the fans of both ends
  /// are left to the caller. O(1).
  void close_edge(Halfedge h);
  /// What `kept` takes over of `removed` besides its fan: its sharpness, if that is larger.
  void take_over(Vertex removed, Vertex kept);
  /// Updates the list of bow-tie copies before `removed` is merged into `kept`, which moves to `p`:
  /// a copy stays in the list if `p` is its position. O(log k) in their number; O(k log k) where
  /// one of the two is a copy. Not for several threads at once, unlike the steps above.
  void merge_bow_tie_copies(Vertex removed, Vertex kept, const glm::vec3& p);
  /// Moves the last vertex into the place of `v`, which no face uses any more and which is no copy
  /// of a bow-tie vertex. O(valence).
  CollapseResult::Move remove_vertex(Vertex v);
  /// Moves the last face into the place of `f`, which no twin or outgoing names any more. O(1).
  CollapseResult::Move remove_face(Face f);

 private:
  Mesh& mesh_;
};

}  // namespace mesher
