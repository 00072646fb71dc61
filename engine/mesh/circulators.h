#pragma once

#include <cstddef>
#include <iterator>

#include "engine/mesh/mesh.h"

namespace mesher {

/// A counter-clockwise sweep around a vertex, starting at outgoing(v). The projection defines the
/// value of each step. A step is a *spoke*: an edge at the vertex. A boundary vertex has one spoke
/// more than faces, and its last spoke has only an incoming half-edge. Projections that yield edges
/// or neighbors include the last spoke; those that yield faces or outgoing half-edges do not. O(1)
/// per step, O(valence) in total. Any edit of the mesh invalidates the iterators.
template <class Projection>
class Around {
 public:
  class Iterator {
   public:
    using value_type = typename Projection::Value;
    using difference_type = std::ptrdiff_t;
    using iterator_concept = std::forward_iterator_tag;

    Iterator() = default;
    Iterator(const Mesh& mesh, Halfedge start) : mesh_(&mesh), start_(start), at_(start) {}

    value_type operator*() const { return Projection::value(*mesh_, at_, is_last_spoke_); }

    Iterator& operator++() {
      const Halfedge incoming = Mesh::prev(at_);
      const Halfedge onward = mesh_->twin(incoming);
      if (is_last_spoke_ || onward == start_) {
        at_ = Halfedge{};
      } else if (onward.is_valid()) {
        at_ = onward;
      } else {
        at_ = Projection::kYieldsLastSpoke ? incoming : Halfedge{};
        is_last_spoke_ = true;
      }
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
    Halfedge start_;
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
