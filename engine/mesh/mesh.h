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

/// Sharpness of an edge that never gets smooth.
inline constexpr float kInfinitelySharp = std::numeric_limits<float>::infinity();

/// What an edge is, as the renderer draws it.
enum class EdgeClass : std::uint8_t { ordinary = 0, crease = 1, boundary = 2 };

/// A triangle mesh as flat half-edge arrays, which are the GPU's buffers as they stand (directed
/// edges: S. Campagna, L. Kobbelt, H.-P. Seidel, "Directed edges: a scalable representation for
/// triangle meshes", 1998).
///
/// Face `f` owns half-edges 3f, 3f+1, 3f+2; half-edge h runs from `origin(h)` to
/// `origin(next(h))`, counter-clockwise around its face. Next, previous and face are arithmetic;
/// only the twin is stored. `origins()` is the index buffer, `positions()` the vertex buffer.
/// 44 bytes a face at V = F/2.
///
/// Invariants, checked by `validate` (engine/mesh/validate.h) under these numbers:
///  1. Array sizes agree: 3F origins, twins, sharpnesses; V positions and outgoing half-edges.
///  2. Every origin is a vertex below V; every twin is none or a half-edge below 3F; every outgoing
///     half-edge is none or below 3F.
///  3. Twins are mutual, and no half-edge is its own twin: twin(twin(h)) == h.
///  4. Twins run opposite ways: origin(twin(h)) == target(h) and target(twin(h)) == origin(h).
///  5. No face is degenerate: its three vertices differ.
///  6. No two faces have the same three vertices.
///  7. outgoing(v) starts at v, and is none exactly where no face uses v.
///  8. The faces around a vertex are one fan: one sweep from outgoing(v) meets each of its
///  half-edges.
///  9. outgoing(v) of a boundary vertex is the half-edge without twin: the sweep starts there.
/// 10. No edge has more than two faces: a pair of vertices is joined by at most one half-edge each
///     way, and one without a twin has no counterpart.
/// 11. Sharpness is a number >= 0 or infinity, and equal on twins.
/// 12. Positions are finite.
/// 13. The copies of bow-tie vertices ascend by vertex, and faces use each. `first` is the lowest
///     of the copies that name it, which are at least two.
/// 14. The copies of one bow-tie vertex have the same position.
class Mesh {
 public:
  Mesh() = default;

  std::uint32_t vertex_count() const { return static_cast<std::uint32_t>(position_.size()); }
  std::uint32_t face_count() const { return static_cast<std::uint32_t>(origin_.size() / 3); }
  std::uint32_t halfedge_count() const { return static_cast<std::uint32_t>(origin_.size()); }

  // Navigation. All O(1) and without a branch but for `rotate_*` at a boundary.

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
  /// None on a boundary.
  Halfedge twin(Halfedge h) const { return twin_[h.index()]; }
  /// Where the sweep around `v` starts: on a boundary vertex, the half-edge with no face on its
  /// right. None where no face uses `v`.
  Halfedge outgoing(Vertex v) const { return outgoing_[v.index()]; }
  /// The next half-edge out of origin(h), counter-clockwise; none past the last face of a boundary
  /// vertex.
  Halfedge rotate_ccw(Halfedge h) const { return twin(prev(h)); }
  /// The same clockwise.
  Halfedge rotate_cw(Halfedge h) const {
    const Halfedge t = twin(h);
    return t.is_valid() ? next(t) : t;
  }
  Edge edge(Halfedge h) const {
    const Halfedge t = twin(h);  // none is the highest index of all
    return Edge(t < h ? t.index() : h.index());
  }

  // Questions.

  bool is_boundary(Halfedge h) const { return !twin(h).is_valid(); }
  bool is_boundary(Edge e) const { return is_boundary(halfedge(e)); }
  /// False for an isolated vertex.
  bool is_boundary(Vertex v) const { return !is_isolated(v) && is_boundary(outgoing(v)); }
  bool is_isolated(Vertex v) const { return !outgoing(v).is_valid(); }
  /// Number of edges at `v`. O(valence).
  std::uint32_t valence(Vertex v) const;
  /// The half-edge from `a` to `b`, or none. O(valence of a).
  Halfedge find_halfedge(Vertex a, Vertex b) const;
  /// The edge between `a` and `b`, whichever way its faces run, or none. O(valence).
  Edge find_edge(Vertex a, Vertex b) const;
  /// Number of edges. O(F).
  std::uint32_t count_edges() const;

  // Values.

  const glm::vec3& position(Vertex v) const { return position_[v.index()]; }
  /// 0: smooth; a number: semi-sharp for so many subdivision steps; infinity: a crease for ever.
  float sharpness(Halfedge h) const { return sharpness_[h.index()]; }
  /// A vertex's own sharpness (OpenSubdiv's "corner"): 0 unless set.
  float sharpness(Vertex v) const {
    return vertex_sharpness_.empty() ? 0.0F : vertex_sharpness_[v.index()];
  }
  EdgeClass edge_class(Halfedge h) const {
    if (is_boundary(h)) return EdgeClass::boundary;
    return sharpness(h) > 0.0F ? EdgeClass::crease : EdgeClass::ordinary;
  }

  /// Whether a vertex is one of the copies of a bow-tie vertex. O(log k) in their number.
  bool is_bow_tie_copy(Vertex v) const {
    return std::ranges::binary_search(bow_tie_copies_, v, {}, &BowTieCopy::v);
  }

  // The arrays, as the GPU and bulk algorithms read them.

  std::span<const glm::vec3> positions() const { return position_; }  ///< V, model units
  std::span<const Vertex> origins() const { return origin_; }         ///< 3F: the index buffer
  std::span<const Halfedge> twins() const { return twin_; }           ///< 3F
  std::span<const Halfedge> outgoings() const { return outgoing_; }   ///< V
  std::span<const float> sharpnesses() const { return sharpness_; }   ///< 3F
  /// V, or empty where no vertex has a sharpness of its own.
  std::span<const float> vertex_sharpnesses() const { return vertex_sharpness_; }
  /// Sparse, ascending by vertex: empty for nearly all meshes. See invariants 13 and 14.
  std::span<const BowTieCopy> bow_tie_copies() const { return bow_tie_copies_; }
  /// Bytes that the arrays occupy.
  std::size_t memory_bytes() const;

  // Edits. Each is O(1) and notes what it touched of the GPU's arrays in `changes()`.

  /// Pre: `p` is finite. A caller that moves a copy of a bow-tie vertex must move all of them
  /// (invariant 14).
  void set_position(Vertex v, const glm::vec3& p);
  /// Both half-edges of the edge. Pre: sharpness >= 0.
  void set_sharpness(Edge e, float sharpness);
  /// No GPU array has it. O(V) the first time. Pre: sharpness >= 0.
  void set_sharpness(Vertex v, float sharpness);

  ChangeLog& changes() { return changes_; }
  const ChangeLog& changes() const { return changes_; }

 private:
  // MeshArrays is how bulk builders (soup, subdivision, codecs) make a mesh of finished arrays.
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

/// The arrays of a mesh, open. For code that makes a whole mesh at once; whoever fills them answers
/// for the invariants of Mesh.
class MeshArrays {
 public:
  Array<glm::vec3> position;
  Array<Vertex> origin;
  Array<Halfedge> twin;
  Array<Halfedge> outgoing;
  Array<float> sharpness;
  Array<float> vertex_sharpness;     ///< may stay empty
  Array<BowTieCopy> bow_tie_copies;  ///< may stay empty

  /// Moves the arrays into a mesh; nothing is checked here (see `validate`). O(1).
  Mesh finish() &&;
  /// Takes a mesh apart. O(1).
  static MeshArrays take(Mesh&& mesh);

  /// The arrays of a mesh where they are: for what is too short to take a mesh apart for. Changes
  /// are the caller's to note.
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
