#pragma once

#include <concepts>
#include <cstddef>
#include <iterator>
#include <span>

#include "engine/mesh/mesh.h"

namespace mesher {

/// What a walk around a vertex needs: the next half-edge out of the same vertex in either
/// direction, or none past a boundary. A Mesh has it, and so have one level of a subdivision
/// (LevelView), an array of twins (TwinView), and a mesh as it will be after a collapse.
template <class C>
concept Connectivity = requires(const C& connectivity, Halfedge h) {
  { connectivity.rotate_ccw(h) } -> std::same_as<Halfedge>;
  { connectivity.rotate_cw(h) } -> std::same_as<Halfedge>;
};

/// The connectivity that an array of twins gives.
struct TwinView {
  std::span<const Halfedge> twin;

  Halfedge rotate_ccw(Halfedge h) const { return twin[Mesh::prev(h).index()]; }
  Halfedge rotate_cw(Halfedge h) const {
    const Halfedge t = twin[h.index()];
    return t.is_valid() ? Mesh::next(t) : t;
  }
};

enum class Turn { ccw, cw };

/// Visits the half-edges out of a vertex one after the other:
///
///   Circulator at(mesh, mesh.outgoing(v));
///   do visit(*at); while (at.advance());
///
/// O(1) per step. Refers to the connectivity. Pre: `start` is valid.
template <Connectivity C, Turn direction = Turn::ccw>
class Circulator {
 public:
  Circulator() = default;
  Circulator(const C& connectivity, Halfedge start)
      : connectivity_(&connectivity), start_(start), at_(start) {}

  Halfedge operator*() const { return at_; }

  /// Moves to the next half-edge. Returns false if there is none: the walk has come back to its
  /// start, or has met the boundary.
  bool advance() {
    at_ = direction == Turn::ccw ? connectivity_->rotate_ccw(at_) : connectivity_->rotate_cw(at_);
    return at_.is_valid() && at_ != start_;
  }

  /// Returns whether the walk came back to its start rather than to a boundary. Pre: `advance` has
  /// returned false.
  bool is_closed() const { return at_.is_valid(); }

 private:
  const C* connectivity_ = nullptr;
  Halfedge start_;
  Halfedge at_;
};

/// Returns the half-edge, out of the same vertex as `h`, at which a counterclockwise walk visits
/// all faces: the one on the boundary, or `h` itself if the faces close around the vertex.
/// O(valence).
template <Connectivity C>
Halfedge first_of_fan(const C& connectivity, Halfedge h) {
  Circulator<C, Turn::cw> at(connectivity, h);
  Halfedge first = h;
  while (at.advance())
    first = *at;
  return at.is_closed() ? h : first;
}

/// A counterclockwise sweep around a vertex, starting at outgoing(v), as a range. The projection
/// defines the value of each step. A step is a *spoke*: an edge at the vertex. A boundary vertex
/// has one spoke more than faces, and its last spoke has only an incoming half-edge. Projections
/// that yield edges or neighbors include the last spoke; those that yield faces or outgoing
/// half-edges do not. O(1) per step, O(valence) in total. Any edit of the mesh invalidates the
/// iterators.
template <class Projection>
class Around {
 public:
  class Iterator {
   public:
    using value_type = typename Projection::Value;
    using difference_type = std::ptrdiff_t;
    using iterator_concept = std::forward_iterator_tag;

    Iterator() = default;
    Iterator(const Mesh& mesh, Halfedge start) : mesh_(&mesh), walk_(mesh, start), at_(start) {}

    value_type operator*() const { return Projection::value(*mesh_, at_, is_last_spoke_); }

    Iterator& operator++() {
      if (!is_last_spoke_ && walk_.advance()) {
        at_ = *walk_;
        return *this;
      }
      is_last_spoke_ = !is_last_spoke_ && !walk_.is_closed();
      at_ = Projection::kYieldsLastSpoke && is_last_spoke_ ? Mesh::prev(at_) : Halfedge{};
      return *this;
    }
    Iterator operator++(int) {
      Iterator before = *this;
      ++*this;
      return before;
    }
    friend bool operator==(const Iterator& a, const Iterator& b) { return a.at_ == b.at_; }

   private:
    const Mesh* mesh_ = nullptr;
    Circulator<Mesh> walk_;
    Halfedge at_;
    bool is_last_spoke_ = false;
  };

  Around(const Mesh& mesh, Vertex v) : mesh_(mesh), start_(mesh.outgoing(v)) {}
  Iterator begin() const { return Iterator(mesh_, start_); }
  Iterator end() const { return Iterator(mesh_, Halfedge{}); }

 private:
  const Mesh& mesh_;
  Halfedge start_;
};

struct ProjectHalfedge {
  using Value = Halfedge;
  static constexpr bool kYieldsLastSpoke = false;
  static Value value(const Mesh&, Halfedge h, bool) { return h; }
};
struct ProjectFace {
  using Value = Face;
  static constexpr bool kYieldsLastSpoke = false;
  static Value value(const Mesh&, Halfedge h, bool) { return Mesh::face(h); }
};
struct ProjectVertex {
  using Value = Vertex;
  static constexpr bool kYieldsLastSpoke = true;
  static Value value(const Mesh& mesh, Halfedge h, bool comes_in) {
    return comes_in ? mesh.origin(h) : mesh.target(h);
  }
};
struct ProjectEdge {
  using Value = Edge;
  static constexpr bool kYieldsLastSpoke = true;
  static Value value(const Mesh& mesh, Halfedge h, bool) { return mesh.edge(h); }
};

/// Returns the outgoing half-edges of `v`, one per face.
inline auto halfedges_around(const Mesh& mesh, Vertex v) {
  return Around<ProjectHalfedge>(mesh, v);
}
/// Returns the faces at `v`.
inline auto faces_around(const Mesh& mesh, Vertex v) {
  return Around<ProjectFace>(mesh, v);
}
/// Returns the one-ring of `v`; on a boundary vertex, from one boundary neighbor to the other.
inline auto vertices_around(const Mesh& mesh, Vertex v) {
  return Around<ProjectVertex>(mesh, v);
}
/// Returns the edges at `v`, in the order of the one-ring.
inline auto edges_around(const Mesh& mesh, Vertex v) {
  return Around<ProjectEdge>(mesh, v);
}

}  // namespace mesher
