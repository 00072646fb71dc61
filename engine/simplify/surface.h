#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <utility>

#include "engine/core/array.h"
#include "engine/core/prefetch.h"
#include "engine/mesh/mesh.h"
#include "engine/simplify/options.h"
#include "engine/simplify/quadric.h"
#include "engine/simplify/surface_state.h"

namespace mesher::simplify {

template <class F>
struct UnitAndArea {
  Vec3<F> unit;
  F area;
};

/// Returns unit normal and area of a triangle from two of its sides; zero if it has no area. O(1).
template <class F>
UnitAndArea<F> unit_and_area(const Vec3<F>& ab, const Vec3<F>& ac) {
  const Vec3<F> n = cross(ab, ac);
  const F length = square_root(dot(n, n));
  const F zero = broadcast<F>(0.0F);
  const F inverse = select(length > zero, broadcast<F>(1.0F) / length, zero);
  return {n * inverse, length * broadcast<F>(0.5F)};
}

/// Returns the quadric rows that a face's plane adds to its corners. `shape`: x, y, z, area.
inline QuadricRows plane_rows(Float4 n) {
  const Float4 w = n * __builtin_shufflevector(n, n, 3, 3, 3, 3);
  const Float4 x =
      __builtin_shufflevector(w, w, 0, 0, 0, 1) * __builtin_shufflevector(n, n, 0, 1, 2, 1);
  const Float4 one = broadcast<Float4>(1.0F);
  const Float4 z_one = __builtin_shufflevector(n, one, 2, 2, 4, 4);
  const Float4 y = __builtin_shufflevector(w, w, 1, 2, 0, 1) * z_one;
  const Float4 g = __builtin_shufflevector(w, Float4{}, 2, 4, 4, 4);
  return {x, y, g};
}

/// Returns the quadric that a face's plane adds to its corners.
inline Quadric<float> plane_quadric(const FaceShape& shape) {
  return plane_quadric(Vec3<float>{shape.normal.x, shape.normal.y, shape.normal.z}, shape.area);
}

/// Weight of the plane across a feature edge, relative to a face whose area is the squared length
/// of the edge: large enough that boundaries are straightened last, small enough that their
/// surroundings still count.
inline constexpr float kFeatureWeight = 1.0F;
/// Same, of seams that are free: along a straight seam still costs less than across.
inline constexpr float kFreeSeamWeight = 0.1F;

/// A mesh under simplification, with data per face and vertex. Removed faces and vertices leave
/// holes until the end, so that ids stay valid.
///
/// Invariants besides those of Mesh (which hold for the live part):
///  S1. shape(f) is the shape of the face's current corners.
///  S2. state(v).quadric is the sum of the contributions of the faces at v (within rounding), and
///      state(v).position is the mesh's.
///  S3. constraint(v) follows from the feature edges at v as VertexConstraint says. Both halves of
///      an edge agree on being a feature; boundary edges are features.
///  S4. A removed face has invalid origins; a removed vertex has no outgoing half-edge.
class Surface {
 public:
  /// Takes ownership of the mesh. O(F), parallel.
  Surface(Mesh&& mesh, const SimplifyOptions& options);

  const Mesh& mesh() const { return mesh_; }
  Mesh& mesh() { return mesh_; }

  bool is_removed(Face f) const { return !mesh_.origin(Mesh::halfedge(f)).is_valid(); }
  const FaceShape& shape(Face f) const { return faces_[f.index()].shape; }
  /// Same, as four floats: x, y, z, area.
  Float4 shape_row(Face f) const { return load4(&shape(f).normal.x); }
  ShapeLanes shapes(const std::array<Face, 4>& faces) const {
    std::array<Float4, 4> rows;
    for (std::size_t lane = 0; lane < 4; ++lane)
      rows[lane] = shape_row(faces[lane]);
    transpose(rows[0], rows[1], rows[2], rows[3]);
    return {{rows[0], rows[1], rows[2]}, rows[3]};
  }
  /// Returns the faces' normals in the input, within 0.1 degrees; zero for a face without area.
  Vec3<Float4> first_normals(const std::array<Face, 4>& faces) const {
    Int4 packed;
    for (std::size_t lane = 0; lane < 4; ++lane)
      packed[lane] = static_cast<std::int32_t>(faces_[faces[lane].index()].first_normal);
    const auto unpack = [&](int shift) {
      // Shifted to the top first, so that the shift down extends the sign.
      return to_float(packed << (22 - shift) >> 22) * broadcast<Float4>(1.0F / 511.0F);
    };
    return {unpack(0), unpack(10), unpack(20)};
  }
  const VertexState& state(Vertex v) const { return vertices_[v.index()]; }
  StateLanes<Float4> states(const Vertex* four) const {
    std::array<std::array<Float4, 4>, 3> rows;
    for (std::size_t k = 0; k < 3; ++k) {
      for (std::size_t lane = 0; lane < 4; ++lane)
        rows[k][lane] = load4(&state(four[lane]).quadric.xx + 4 * k);
      transpose(rows[k][0], rows[k][1], rows[k][2], rows[k][3]);
    }
    const auto& [a, b, c] = rows;
    return {{a[0], a[1], a[2], a[3], b[0], b[1], {b[2], b[3], c[0]}}, {c[1], c[2], c[3]}};
  }
  StateLanes<Float8> states(const std::array<Vertex, 8>& eight) const {
    const StateLanes<Float4> low = states(eight.data());
    const StateLanes<Float4> high = states(eight.data() + 4);
    const Quadric<Float4>& p = low.quadric;
    const Quadric<Float4>& q = high.quadric;
    return {{{p.xx, q.xx},
             {p.xy, q.xy},
             {p.xz, q.xz},
             {p.yy, q.yy},
             {p.yz, q.yz},
             {p.zz, q.zz},
             pair(p.g, q.g)},
            pair(low.position, high.position)};
  }
  VertexConstraint constraint(Vertex v) const { return state(v).constraint; }
  /// Returns the last known cost of the edge of `h` if the origin of `h` owns the edge; otherwise
  /// kNever. O(1).
  float cost(Halfedge h) const { return faces_[Mesh::face(h).index()].cost[Mesh::corner(h)]; }
  EdgeKind kind(Halfedge h) const { return has_features_ ? feature_[h.index()] : EdgeKind::smooth; }
  bool is_feature(Halfedge h) const { return kind(h) != EdgeKind::smooth; }
  /// Returns the weight of the planes across a feature edge.
  float feature_weight(Halfedge h) const {
    return kind(h) == EdgeKind::seam ? seam_weight_ : kFeatureWeight;
  }
  /// Returns whether the edge of `h` and both other sides of a face at it are at least of a kind.
  /// O(1).
  bool is_in_loop(Halfedge h, EdgeKind least) const;
  /// Returns the area of the input mesh.
  double area_before() const { return area_before_; }
  /// Returns whether any vertex may be constrained.
  bool is_constrained() const { return is_constrained_; }

  /// Returns where the edge of `h` may be merged. Features collapse only along themselves. O(1).
  AllowedPlacement allowed_placement(Halfedge h) const {
    const VertexConstraint from = constraint(mesh_.origin(h));
    const VertexConstraint to = constraint(mesh_.target(h));
    if (from == VertexConstraint::free && to == VertexConstraint::free)
      return AllowedPlacement::anywhere;
    return constrained_placement(h, from, to);
  }
  /// Returns whether there are seams that collapses may cross, at their full price.
  bool can_free_seams() const { return has_seams_ && !seams_are_free(); }
  bool seams_are_free() const { return seam_weight_ < kFeatureWeight; }
  /// From now on, planes across seams count less, and a collapse across one may place its vertex
  /// anywhere. Forgets all costs. Pre: can_free_seams(). O(F).
  void free_seams();
  /// Returns at which ends an edge may be merged across seams; `anywhere`: at both. O(1).
  AllowedPlacement ends_across(Halfedge h) const;
  /// O(1).
  Vec3<float> midpoint(Halfedge h) const {
    const Vec3<float>& from = state(mesh_.origin(h)).position;
    return from + (state(mesh_.target(h)).position - from) * 0.5F;
  }
  /// O(1).
  EdgeQuadric<float> edge_quadric(Halfedge h) const {
    const VertexState& from = state(mesh_.origin(h));
    const VertexState& to = state(mesh_.target(h));
    const Halfedge t = mesh_.twin(h);
    Vec3<float> shared = shape(Mesh::face(h)).area_vector();
    if (t.is_valid()) shared = shared + shape(Mesh::face(t)).area_vector();
    return {from.quadric, to.quadric, shared, to.position - from.position};
  }
  /// Returns the states of both ends of eight edges.
  auto ends(const std::array<Halfedge, 8>& edges) const {
    std::array<Vertex, 8> from, to;
    for (std::size_t lane = 0; lane < 8; ++lane) {
      from[lane] = mesh_.origin(edges[lane]);
      to[lane] = mesh_.target(edges[lane]);
    }
    return std::pair{states(from), states(to)};
  }
  /// Returns the quadrics of eight edges. Pre: none of them is a feature or on the boundary.
  EdgeQuadric<Float8> edge_quadrics(const std::array<Halfedge, 8>& edges) const;

  // Changes by a collapse, besides those to the mesh itself.
  void set_shape(Face f, Float4 shape) { store4(&faces_[f.index()].shape.normal.x, shape); }
  /// Returns a bit per half-edge of each face: whether its edge was refused.
  const Array<std::uint8_t>& refused() const { return refused_; }
  void set_refused(Array<std::uint8_t>&& refused) { refused_ = std::move(refused); }
  /// Notes that an edge was refused. Returns false if it, or one merged into it, was before. O(1).
  bool note_refused(Halfedge h);
  void set_kind(Halfedge h, EdgeKind kind) { feature_[h.index()] = kind; }
  /// Finds the constraint of a vertex again, after a collapse across seams. O(valence).
  void update_constraint(Vertex v);
  /// Moves a vertex and clears its quadric.
  void move_and_clear_quadric(Vertex v, const glm::vec3& p) {
    state(v).quadric = {};
    state(v).position = {p.x, p.y, p.z};
  }
  /// Adds to a vertex's quadric. Pre: the unused lanes of the last row are zero.
  void add(Vertex v, const QuadricRows& rows) {
    float* at = &state(v).quadric.xx;
    store4(at, load4(at) + rows.a);
    store4(at + 4, load4(at + 4) + rows.b);
    store4(at + 8, load4(at + 8) + rows.c);
  }
  VertexState& state(Vertex v) { return vertices_[v.index()]; }
  void will_need(Vertex v) const { prefetch(&vertices_[v.index()]); }
  void will_need(Halfedge h) const {
    prefetch(&faces_[Mesh::face(h).index()]);
    prefetch(&mesh_.origins()[h.index()]);
    prefetch(&mesh_.twins()[h.index()]);
  }
  void set_cost(Halfedge h, float cost) {
    faces_[Mesh::face(h).index()].cost[Mesh::corner(h)] = cost;
  }

  /// Returns what a face adds to the quadrics of its corners, in their order: its plane weighted by
  /// area, and for each feature edge a plane across it, which keeps features in place. O(1).
  std::array<Quadric<float>, 3> contributions(Face f) const;
  /// Computes all shapes and quadrics again, after collapses that changed the mesh only. O(F).
  void recompute();
  /// Returns the vector across the feature edge of `h` in its face's plane, as long as the edge.
  glm::vec3 across(Halfedge h) const;
  bool has_feature(Face f) const {
    const std::uint32_t h = 3 * f.index();
    return is_feature(Halfedge(h)) || is_feature(Halfedge(h + 1)) || is_feature(Halfedge(h + 2));
  }

 private:
  AllowedPlacement constrained_placement(Halfedge h, VertexConstraint from,
                                         VertexConstraint to) const;
  Quadric<float> across_quadric(Halfedge h) const;
  void add_features(Halfedge h);
  FaceShape shape_of(Face f) const;
  void sum_quadrics();
  void find_shapes();
  void find_features(const SimplifyOptions& options);
  void find_states();
  void find_constraints(const SimplifyOptions& options);

  Mesh mesh_;
  bool has_features_ = false;    ///< edges
  bool is_constrained_ = false;  ///< vertices: features, own sharpness, bow ties
  bool crosses_seams_ = false;
  bool has_seams_ = false;  ///< EdgeKind::seam
  float seam_weight_ = kFeatureWeight;
  double area_before_ = 0.0;
  Array<FaceState> faces_;
  Array<VertexState> vertices_;
  Array<std::uint8_t> refused_;  ///< of each face: a bit per half-edge whose edge was refused
  Array<EdgeKind> feature_;
};

}  // namespace mesher::simplify
