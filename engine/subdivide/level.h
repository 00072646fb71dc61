#pragma once

#include <glm/vec3.hpp>
#include <span>

#include "engine/core/array.h"
#include "engine/mesh/circulators.h"
#include "engine/mesh/ids.h"
#include "engine/mesh/mesh.h"
#include "engine/subdivide/point.h"

namespace mesher::subdivide {

/// The arrays that subdivision reads, of a Mesh or an intermediate level: those of a mesh without
/// sharpness. All invariants of Mesh hold.
struct LevelView {
  std::span<const glm::vec3> position;  ///< V
  std::span<const Vertex> origin;       ///< 3F
  std::span<const Halfedge> twin;       ///< 3F
  std::span<const Halfedge> outgoing;   ///< V

  std::uint32_t vertex_count() const { return static_cast<std::uint32_t>(position.size()); }
  std::uint32_t face_count() const { return static_cast<std::uint32_t>(origin.size() / 3); }
  Point point(Vertex v) const { return Point(position[v.index()]); }
  /// Returns the position of the origin of `h`.
  Point from(Halfedge h) const { return point(origin[h.index()]); }
  Point to(Halfedge h) const { return from(Mesh::next(h)); }

  Halfedge rotate_ccw(Halfedge h) const { return TwinView{twin}.rotate_ccw(h); }
  Halfedge rotate_cw(Halfedge h) const { return TwinView{twin}.rotate_cw(h); }
};

/// The same arrays, owned. `twin` and `outgoing` are empty on a last level without connectivity.
struct Level {
  Array<glm::vec3> position;
  Array<Vertex> origin;
  Array<Halfedge> twin;
  Array<Halfedge> outgoing;

  LevelView view() const { return {position, origin, twin, outgoing}; }
};

LevelView view_of(const Mesh& mesh);

// The indices of half-edges on the next level follow by arithmetic, without lookup or hashing. Face
// f = (a, b, c) has the children 4f = (a, ab, ca), 4f+1 = (ab, b, bc), 4f+2 = (ca, bc, c) and 4f+3
// = (ab, bc, ca).

/// Returns the half of `h` that starts at its origin.
constexpr Halfedge first_half(Halfedge h) {
  return Halfedge(4 * h.index());
}
/// Returns the half of `h` that ends at its target; it starts at the new vertex.
constexpr Halfedge second_half(Halfedge h) {
  return Halfedge(4 * h.index() + (h.index() % 3 == 2 ? -6U : 3U));
}
/// Returns the half-edge whose second half is `half`.
constexpr Halfedge whole_of_second(Halfedge half) {
  return Halfedge((half.index() % 12 == 2 ? half.index() + 6 : half.index() - 3) / 4);
}
/// Returns the new vertex on the edge of `h`.
inline Vertex edge_vertex(const Level& finer, Halfedge h) {
  return finer.origin[second_half(h).index()];
}

}  // namespace mesher::subdivide
