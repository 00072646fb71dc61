#pragma once

#include <cmath>
#include <glm/vec3.hpp>
#include <limits>
#include <span>

#include "engine/core/array.h"
#include "engine/core/assert.h"
#include "engine/mesh/bow_tie.h"
#include "engine/mesh/change_log.h"
#include "engine/mesh/ids.h"

namespace mesher {

/// The sharpness of an edge that never becomes smooth.
inline constexpr float kInfinitelySharp = std::numeric_limits<float>::infinity();

/// The class of an edge for rendering.
enum class EdgeClass : std::uint8_t { ordinary = 0, crease = 1, boundary = 2 };

/// A triangle mesh as flat half-edge arrays, which are also the GPU's buffers (directed edges: S.
/// Campagna, L. Kobbelt, H.-P. Seidel, "Directed edges: a scalable representation for triangle
/// meshes", 1998).
///
/// Face `f` owns half-edges 3f, 3f+1, 3f+2; half-edge h runs from `origin(h)` to `origin(next(h))`,
/// counterclockwise around its face. Next, previous and face are arithmetic; only the twin is
/// stored. `origins()` is the index buffer, `positions()` the vertex buffer. 44 bytes per face at V
/// = F/2.
///
/// Invariants, checked by `validate` (engine/mesh/validate.h) under these numbers:
///  1. Array sizes agree: 3F origins, twins, sharpnesses; V positions and outgoing half-edges.
///  2. Every origin is a vertex below V; every twin is none or a half-edge below 3F; every outgoing
///     half-edge is none or below 3F.
///  3. Twins are mutual, and no half-edge is its own twin: twin(twin(h)) == h.
///  4. Twins run opposite ways: origin(twin(h)) == target(h) and target(twin(h)) == origin(h).
///  5. No face is degenerate: its three vertices differ.
///  6. No two faces have the same three vertices.
///  7. outgoing(v) starts at v, and is none exactly if no face uses v.
///  8. The faces around a vertex are one fan: one sweep from outgoing(v) visits each of its
///     half-edges.
///  9. outgoing(v) of a boundary vertex is the half-edge without twin: the sweep starts there.
/// 10. No edge has more than two faces: a pair of vertices is joined by at most one half-edge in
///     each direction, and a half-edge without a twin has no counterpart.
/// 11. Sharpness is a number >= 0 or infinity, and equal on twins.
/// 12. Positions are finite.
/// 13. The copies of bow-tie vertices ascend by vertex, and each is used by a face. `first` is the
///     lowest of the copies that have it, which are at least two.
/// 14. The copies of one bow-tie vertex have the same position.
class Mesh {
 public:
  Mesh() = default;

  std::uint32_t vertex_count() const { return static_cast<std::uint32_t>(position_.size()); }
  std::uint32_t face_count() const { return static_cast<std::uint32_t>(origin_.size() / 3); }
  std::uint32_t halfedge_count() const { return static_cast<std::uint32_t>(origin_.size()); }

  // Navigation. All are O(1) and without branches, except `rotate_cw`, which tests for a boundary.

  static Halfedge halfedge(Face f, std::uint32_t corner = 0) {
    return Halfedge(3 * f.index() + corner);
  }
  static Halfedge halfedge(Edge e) { return Halfedge(e.index()); }
  static Face face(Halfedge h) { return Face(h.index() / 3); }
  static std::uint32_t corner(Halfedge h) { return h.index() % 3; }
  static Halfedge next(Halfedge h) {
    return Halfedge(h.index() + 1 - (3U & (0U - static_cast<std::uint32_t>(h.index() % 3 == 2))));
  }
  static Halfedge prev(Halfedge h) {
    return Halfedge(h.index() - 1 + (3U & (0U - static_cast<std::uint32_t>(h.index() % 3 == 0))));
  }
  Vertex origin(Halfedge h) const { return origin_[h.index()]; }
  Vertex target(Halfedge h) const { return origin_[next(h).index()]; }
  /// Returns none on a boundary.
  Halfedge twin(Halfedge h) const { return twin_[h.index()]; }
  /// Returns the half-edge at which the sweep around `v` starts: on a boundary vertex, the
  /// half-edge without a face on its right. None if no face uses `v`.
  Halfedge outgoing(Vertex v) const { return outgoing_[v.index()]; }
  /// Returns the next half-edge out of origin(h), counterclockwise; none after the last face of a
  /// boundary vertex.
  Halfedge rotate_ccw(Halfedge h) const { return twin(prev(h)); }
  /// Returns the next half-edge out of origin(h), clockwise; none at the first face of a boundary
  /// vertex.
  Halfedge rotate_cw(Halfedge h) const {
    const Halfedge t = twin(h);
    return t.is_valid() ? next(t) : t;
  }
  Edge edge(Halfedge h) const {
    const Halfedge t = twin(h);  // none is the highest index
    return Edge(t < h ? t.index() : h.index());
  }

  // Queries.

  bool is_boundary(Halfedge h) const { return !twin(h).is_valid(); }
  bool is_boundary(Edge e) const { return is_boundary(halfedge(e)); }
  /// Returns false for an isolated vertex.
  bool is_boundary(Vertex v) const { return !is_isolated(v) && is_boundary(outgoing(v)); }
  bool is_isolated(Vertex v) const { return !outgoing(v).is_valid(); }
  /// Returns the number of edges at `v`. O(valence).
  std::uint32_t valence(Vertex v) const;
  /// Returns the half-edge from `a` to `b`, or none. O(valence of a).
  Halfedge find_halfedge(Vertex a, Vertex b) const;
  /// Returns the edge between `a` and `b`, in either direction, or none. O(valence).
  Edge find_edge(Vertex a, Vertex b) const;
  /// Returns the number of edges. O(F).
  std::uint32_t count_edges() const;

  // Values.

  const glm::vec3& position(Vertex v) const { return position_[v.index()]; }
  /// Returns 0 for a smooth edge, infinity for a permanent crease, and otherwise the number of
  /// subdivision steps for which the edge stays semi-sharp.
  float sharpness(Halfedge h) const { return sharpness_[h.index()]; }
  /// Returns the vertex's own sharpness (OpenSubdiv's "corner"): 0 unless set.
  float sharpness(Vertex v) const {
    return vertex_sharpness_.empty() ? 0.0F : vertex_sharpness_[v.index()];
  }
  EdgeClass edge_class(Halfedge h) const {
    if (is_boundary(h)) return EdgeClass::boundary;
    return sharpness(h) > 0.0F ? EdgeClass::crease : EdgeClass::ordinary;
  }

  /// Returns whether a vertex is one of the copies of a bow-tie vertex. O(log k) in their number.
  bool is_bow_tie_copy(Vertex v) const {
    return std::ranges::binary_search(bow_tie_copies_, v, {}, &BowTieCopy::v);
  }

  // The arrays, as read by the GPU and by bulk algorithms.

  std::span<const glm::vec3> positions() const { return position_; }  ///< V, model units
  std::span<const Vertex> origins() const { return origin_; }         ///< 3F: the index buffer
  std::span<const Halfedge> twins() const { return twin_; }           ///< 3F
  std::span<const Halfedge> outgoings() const { return outgoing_; }   ///< V
  std::span<const float> sharpnesses() const { return sharpness_; }   ///< 3F
  /// V elements, or empty if no vertex has its own sharpness.
  std::span<const float> vertex_sharpnesses() const { return vertex_sharpness_; }
  /// Sparse, ascending by vertex; empty for nearly all meshes. See invariants 13 and 14.
  std::span<const BowTieCopy> bow_tie_copies() const { return bow_tie_copies_; }
  /// Returns the number of bytes that the arrays occupy.
  std::size_t memory_bytes() const;

  // Edits. Each is O(1) and notes its changes to GPU arrays in `changes()`.

  /// Sets the position of a vertex. A caller that moves a copy of a bow-tie vertex must move all of
  /// them (invariant 14). Pre: `p` is finite.
  void set_position(Vertex v, const glm::vec3& p);
  /// Sets the sharpness of both half-edges of an edge. Pre: sharpness >= 0.
  void set_sharpness(Edge e, float sharpness);
  /// Sets the vertex's own sharpness, which no GPU array contains. O(V) the first time. Pre:
  /// sharpness >= 0.
  void set_sharpness(Vertex v, float sharpness);

  ChangeLog& changes() { return changes_; }
  const ChangeLog& changes() const { return changes_; }

 private:
  // Bulk builders (soup, subdivision, codecs) make a mesh from finished arrays through MeshArrays.
  friend class MeshArrays;
  friend class MeshDelta;
  friend class MeshEditor;

  Array<glm::vec3> position_;
  Array<Vertex> origin_;
  Array<Halfedge> twin_;
  Array<Halfedge> outgoing_;
  Array<float> sharpness_;
  Array<float> vertex_sharpness_;
  Array<BowTieCopy> bow_tie_copies_;
  ChangeLog changes_;
};

/// The arrays of a mesh with public access, for code that makes a whole mesh at once. That code
/// must establish the invariants of Mesh.
class MeshArrays {
 public:
  Array<glm::vec3> position;
  Array<Vertex> origin;
  Array<Halfedge> twin;
  Array<Halfedge> outgoing;
  Array<float> sharpness;
  Array<float> vertex_sharpness;     ///< may stay empty
  Array<BowTieCopy> bow_tie_copies;  ///< may stay empty

  /// Moves the arrays into a mesh without checks (see `validate`). O(1).
  Mesh finish() &&;
  /// Moves the arrays out of a mesh. O(1).
  static MeshArrays take(Mesh&& mesh);

  /// References to the arrays of a mesh, for edits that are too small to move the arrays out. The
  /// caller must note its changes.
  struct InPlace {
    Array<glm::vec3>& position;
    Array<Vertex>& origin;
    Array<Halfedge>& twin;
    Array<Halfedge>& outgoing;
    Array<float>& sharpness;
    Array<float>& vertex_sharpness;
    Array<BowTieCopy>& bow_tie_copies;
  };
  static InPlace open(Mesh& mesh);
};

}  // namespace mesher
