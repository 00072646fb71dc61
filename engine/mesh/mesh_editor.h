#pragma once

#include "engine/mesh/collapse.h"
#include "engine/mesh/mesh.h"

namespace mesher {

/// Elementary edits of a mesh's arrays, each noted in its change log. Invariants may be broken
/// between edits; the caller restores them. For engine/mesh and for bulk simplification, which
/// fills the holes at the end instead of after each collapse.
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
  /// Makes every half-edge out of `from` start at `to`. O(valence).
  void move_fan(Vertex from, Vertex to);
  /// Makes outgoing(v) the start of the fan that contains `spoke`: at a boundary, its first
  /// half-edge. O(valence).
  void start_fan_at_boundary(Vertex v, Halfedge spoke);
  /// Gives each pair of edges that will coincide when the edge of `h` is collapsed the larger of
  /// their sharpnesses. O(1).
  void join_sharpness(Halfedge h);
  /// Removes all references to the one or two faces at the edge of `h`; their own entries remain as
  /// holes. The caller handles sharpness (`join_sharpness`, before this) and the fans of both ends.
  /// O(1).
  void close_edge(Halfedge h);
  /// Gives `kept` the sharpness of `removed` if that is larger.
  void take_over(Vertex removed, Vertex kept);
  /// Updates the list of bow-tie copies before `removed` is merged into `kept`, which moves to `p`.
  /// A copy stays in the list if `p` is its position. O(log k) in their number; O(k log k) if one
  /// of the two is a copy. Not thread-safe, unlike the edits above.
  void merge_bow_tie_copies(Vertex removed, Vertex kept, const glm::vec3& p);
  /// Moves the last vertex into the slot of `v`. O(valence). Pre: no face uses `v`, and `v` is not
  /// a copy of a bow-tie vertex.
  CollapseResult::Move remove_vertex(Vertex v);
  /// Moves the last face into the slot of `f`. O(1). Pre: no twin or outgoing half-edge refers to
  /// `f`.
  CollapseResult::Move remove_face(Face f);

 private:
  Mesh& mesh_;
};

}  // namespace mesher
