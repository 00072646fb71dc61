#pragma once

#include "engine/mesh/mesh.h"

namespace mesher {

/// Walks around the next parent a step at a time while something else is computed, so that what
/// will be read there is on its way from memory. It changes nothing but the time: the mesh is that
/// before the split at hand.
class RingPrefetch {
 public:
  /// `v`: may be none, or no vertex yet: not one of the first `vertices`.
  void begin(const Mesh& mesh, std::uint32_t vertices, Vertex v) {
    mesh_ = &mesh;
    v_ = v.index() < vertices ? v : Vertex{};
    at_ = Halfedge{};
    if (v_.is_valid()) __builtin_prefetch(&mesh.outgoings()[v_.index()]);
  }

  /// `prefetch_position`: the address of where a vertex is.
  template <class PrefetchPosition>
  void step(const PrefetchPosition& prefetch_position) {
    if (at_.is_valid()) {
      prefetch_position(mesh_->target(at_));
      turn_to(mesh_->twin(Mesh::prev(at_)));
    } else if (v_.is_valid()) {
      prefetch_position(v_);
      turn_to(mesh_->outgoing(v_));
      v_ = Vertex{};
    }
  }

 private:
  void turn_to(Halfedge h) {
    at_ = h;
    if (!h.is_valid()) return;
    __builtin_prefetch(&mesh_->twins()[h.index()]);
    __builtin_prefetch(&mesh_->origins()[h.index()]);
  }

  const Mesh* mesh_ = nullptr;
  Vertex v_;
  Halfedge at_;
};

}  // namespace mesher
