#pragma once

#include <cstdint>
#include <glm/vec3.hpp>

#include "engine/core/array.h"
#include "engine/mesh/mesh.h"
#include "engine/progressive/pm_format.h"
#include "engine/progressive/vertex_split.h"

namespace mesher {

// Products as docs/pm-format.md writes them out: every reader rounds alike.

inline double dot(const glm::dvec3& a, const glm::dvec3& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
inline glm::dvec3 cross(const glm::dvec3& a, const glm::dvec3& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

/// The edges at a vertex by slot (see SplitCut), in memory that is used again.
class SplitRing {
 public:
  /// False where more faces than the format allows are there. Pre: not isolated.
  bool gather(const Mesh& mesh, Vertex v) {
    out_.clear();
    vertices_.clear();
    const Halfedge start = mesh.outgoing(v);
    Halfedge h = start;
    Halfedge last;
    do {
      if (out_.size() == kPmMostFan) return false;
      out_.push_back(h);
      vertices_.push_back(mesh.target(h));
      last = Mesh::prev(h);
      h = mesh.twin(last);
    } while (h.is_valid() && h != start);
    is_closed_ = h.is_valid();
    if (!is_closed_) vertices_.push_back(mesh.origin(last));
    return true;
  }
  /// Where its vertices are, seen from the parent.
  template <class Position>
  void locate(Vertex parent, const Position& position) {
    at_ = position(parent);
    places_.resize(vertices_.size());
    for (std::size_t i = 0; i < vertices_.size(); ++i)
      places_[i] = position(vertices_[i]) - at_;
  }

  std::uint32_t faces() const { return static_cast<std::uint32_t>(out_.size()); }
  std::uint32_t slots() const { return static_cast<std::uint32_t>(vertices_.size()); }
  bool is_closed() const { return is_closed_; }
  std::uint32_t after(std::uint32_t slot) const { return slot + 1 == slots() ? 0 : slot + 1; }
  /// At the other end of the edge in a slot.
  Vertex vertex(std::uint32_t slot) const { return vertices_[slot]; }
  /// A half of the edge in a slot.
  Halfedge halfedge(std::uint32_t slot) const {
    return slot < out_.size() ? out_[slot] : Mesh::prev(out_[slot - 1]);
  }
  const glm::dvec3& at() const { return at_; }  ///< the parent
  const glm::dvec3& place(std::uint32_t slot) const { return places_[slot]; }

  /// How many faces a cut gives to the child.
  std::uint32_t moved(const SplitCut& cut) const {
    if (cut.right == kNone) return faces() - cut.left;
    return cut.left < cut.right ? cut.right - cut.left : faces() - (cut.left - cut.right);
  }

 private:
  Array<Halfedge> out_;
  Array<Vertex> vertices_;
  Array<glm::dvec3> places_;
  glm::dvec3 at_{0.0};
  bool is_closed_ = false;
};

}  // namespace mesher
