#pragma once

#include "engine/mesh/mesh.h"

namespace mesher::progressive {

/// Prefetches the ring of the next parent, one step at a time, while other work is done, so that
/// its data is in cache when read. Does not affect the result: it reads the mesh as it is before
/// the current split. No circulator: the mesh changes between its steps, so it must not rely on
/// coming back to its start.
class RingPrefetch {
 public:
  /// `v` may be none, or a vertex that does not exist yet: not one of the first `vertices`.
  void begin(const Mesh& mesh, std::uint32_t vertices, Vertex v) {
    mesh_ = &mesh;
    v_ = v.index() < vertices ? v : Vertex{};
    at_ = Halfedge{};
    if (v_.is_valid()) __builtin_prefetch(&mesh.outgoings()[v_.index()]);
  }

  /// `prefetch_position`: function that prefetches the position of a vertex.
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

}  // namespace mesher::progressive
