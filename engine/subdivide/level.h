#pragma once

#include <glm/vec3.hpp>
#include <span>

#include "engine/core/array.h"
#include "engine/mesh/ids.h"
#include "engine/mesh/mesh.h"
#include "engine/subdivide/point.h"

namespace mesher {

/// The arrays of a mesh without its sharpnesses, as subdivision reads them: those of a Mesh, or of
/// a level between. All invariants of Mesh hold.
struct LevelView {
  std::span<const glm::vec3> position;  ///< V
  std::span<const Vertex> origin;       ///< 3F
  std::span<const Halfedge> twin;       ///< 3F
  std::span<const Halfedge> outgoing;   ///< V

  std::uint32_t vertex_count() const { return static_cast<std::uint32_t>(position.size()); }
  std::uint32_t face_count() const { return static_cast<std::uint32_t>(origin.size() / 3); }
  Point point(Vertex v) const { return Point(position[v.index()]); }
  /// Where the origin of `h` is.
  Point from(Halfedge h) const { return point(origin[h.index()]); }
  Point to(Halfedge h) const { return from(Mesh::next(h)); }
};

/// The same, owned. `twin` and `outgoing` are empty on a last level that nobody walks on.
struct Level {
  Array<glm::vec3> position;
  Array<Vertex> origin;
  Array<Halfedge> twin;
  Array<Halfedge> outgoing;

  LevelView view() const { return {position, origin, twin, outgoing}; }
};

LevelView view_of(const Mesh& mesh);

// Where the parts of a mesh are on the next level. Arithmetic: nothing is looked up or hashed.
// Face f = (a, b, c) has the children 4f = (a, ab, ca), 4f+1 = (ab, b, bc), 4f+2 = (ca, bc, c) and
// 4f+3 = (ab, bc, ca).

/// The half of `h` that starts where `h` starts.
constexpr Halfedge first_half(Halfedge h) {
  return Halfedge(4 * h.index());
}
/// The half of `h` that ends where `h` ends; it starts at the new vertex.
constexpr Halfedge second_half(Halfedge h) {
  return Halfedge(4 * h.index() + (h.index() % 3 == 2 ? -6U : 3U));
}
/// What `second_half` made `half` of.
constexpr Halfedge whole_of_second(Halfedge half) {
  return Halfedge((half.index() % 12 == 2 ? half.index() + 6 : half.index() - 3) / 4);
}
/// The new vertex on the edge of `h`.
inline Vertex edge_vertex(const Level& finer, Halfedge h) {
  return finer.origin[second_half(h).index()];
}

}  // namespace mesher
