#pragma once

#include <cstdint>
#include <glm/vec3.hpp>

#include "engine/core/array.h"
#include "engine/mesh/circulators.h"
#include "engine/mesh/mesh.h"
#include "engine/progressive/codec/pm_format.h"
#include "engine/progressive/parent_fan.h"
#include "engine/progressive/vertex_split.h"

namespace mesher::progressive {

// Products written out as in docs/pm-format.md, so that every reader rounds alike.

inline double dot(const glm::dvec3& a, const glm::dvec3& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
inline glm::dvec3 cross(const glm::dvec3& a, const glm::dvec3& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

/// The edges at a vertex by slot (see SplitCut). Reused to avoid allocations.
class SplitRing {
 public:
  /// Gathers the edges, and the positions of their vertices relative to `v`. Returns false if there
  /// are more faces than the format allows. Pre: not isolated.
  template <class Position>
  bool gather(const Mesh& mesh, Vertex v, const Position& position) {
    at_ = position(v);
    Circulator at(mesh, mesh.outgoing(v));
    std::uint32_t count = 0;
    do {
      if (count == kPmMostFan) return false;
      if (count + 1 >= out_.size()) resize(2 * count + 32);
      out_[count] = *at;
      add(count++, mesh.target(*at), position);
    } while (at.advance());
    faces_ = count;
    is_closed_ = at.is_closed();
    last_ = Mesh::prev(out_[count - 1]);
    if (!is_closed_) add(count, mesh.origin(last_), position);
    return true;
  }

  std::uint32_t faces() const { return faces_; }
  std::uint32_t slots() const { return faces_ + (is_closed_ ? 0 : 1); }
  bool is_closed() const { return is_closed_; }
  ParentFan fan() const { return {std::span(out_).first(faces_), is_closed_}; }
  std::uint32_t after(std::uint32_t slot) const { return slot + 1 == slots() ? 0 : slot + 1; }
  /// Returns the vertex at the other end of the edge in a slot.
  Vertex vertex(std::uint32_t slot) const { return vertices_[slot]; }
  /// Returns one half of the edge in a slot.
  Halfedge halfedge(std::uint32_t slot) const { return slot < faces_ ? out_[slot] : last_; }
  const glm::dvec3& at() const { return at_; }  ///< position of the parent
  const glm::dvec3& offset(std::uint32_t slot) const { return offsets_[slot]; }

  /// Returns how many faces a cut moves to the child.
  std::uint32_t moved(const SplitCut& cut) const {
    if (cut.right == kNone) return faces() - cut.left;
    return cut.left < cut.right ? cut.right - cut.left : faces() - (cut.left - cut.right);
  }

 private:
  void resize(std::uint32_t size) {
    out_.resize(size);
    vertices_.resize(size);
    offsets_.resize(size);
  }
  template <class Position>
  void add(std::uint32_t slot, Vertex v, const Position& position) {
    vertices_[slot] = v;
    offsets_[slot] = position(v) - at_;
  }

  Array<Halfedge> out_;
  Array<Vertex> vertices_;
  Array<glm::dvec3> offsets_;
  glm::dvec3 at_{0.0};
  Halfedge last_;
  std::uint32_t faces_ = 0;
  bool is_closed_ = false;
};

}  // namespace mesher::progressive
