#pragma once

#include <algorithm>
#include <array>
#include <cstdint>

#include "engine/core/array.h"
#include "engine/mesh/mesh.h"
#include "engine/progressive/codec/range_coder.h"
#include "engine/progressive/codec/split_ring.h"
#include "engine/progressive/progressive_mesh.h"

namespace mesher::progressive {

/// Models which vertex is split. Vertices of many edges are split more often than those of few, so
/// the number of edges is coded first, then the vertex among those with that number.
class ParentCoder {
 public:
  /// Starts with the vertices of the base. O(V + F). Pre: the mesh is at its base.
  void begin(const ProgressiveMesh& pm) {
    const Mesh& base = pm.mesh();
    edges_.assign(pm.base_vertex_count(), 0);
    slot_.resize(pm.base_vertex_count());
    for (std::uint32_t i = 0; i < 3 * pm.base_face_count(); ++i) {
      const Halfedge h(i);
      ++edges_[base.origin(h).index()];
      if (base.is_boundary(h)) ++edges_[base.target(h).index()];
    }
    for (std::uint32_t v = 0; v < edges_.size(); ++v) {
      if (edges_[v] != 0) insert(v);
    }
  }

  /// Codes a parent. When decoding, returns none if there is no such vertex.
  template <class Coder>
  Vertex code(Coder& coder, Vertex parent) {
    std::uint32_t which = 0;
    std::uint32_t slot = 0;
    if constexpr (!Coder::kDecodes) {
      which = class_of(parent.index());
      slot = slot_[parent.index()];
    }
    const Array<std::uint32_t>& members = classes_[class_.code(coder, which)];
    if (members.empty()) return {};
    slot = coder.uniform(slot, static_cast<std::uint32_t>(members.size()));
    return Vertex(members[slot]);
  }

  /// Updates the edge counts for a split of the vertex with this ring.
  void note(const SplitRing& ring, Vertex parent, const SplitCut& cut) {
    const bool is_pair = cut.right != kNone;
    const std::uint32_t opened = is_pair ? 2 : 1;
    const std::uint32_t moved = ring.moved(cut);
    const bool is_child_open = !ring.is_closed() && (!is_pair || cut.left > cut.right);
    const bool is_parent_open = !ring.is_closed() && (!is_pair || cut.left < cut.right);
    change(parent.index(), ring.faces() - moved + opened + (is_parent_open ? 1 : 0));
    edges_.push_back(moved + opened + (is_child_open ? 1 : 0));
    slot_.push_back(0);
    insert(static_cast<std::uint32_t>(edges_.size()) - 1);
    grow(ring.vertex(cut.left).index());
    if (is_pair) grow(ring.vertex(cut.right).index());
  }

 private:
  static constexpr std::uint32_t kClassBits = 4;
  static constexpr std::uint32_t kMost = (1U << kClassBits) - 1;

  std::uint32_t class_of(std::uint32_t v) const { return std::min(edges_[v], kMost); }
  void insert(std::uint32_t v) {
    Array<std::uint32_t>& members = classes_[class_of(v)];
    slot_[v] = static_cast<std::uint32_t>(members.size());
    members.push_back(v);
  }
  /// Removes a vertex from its class: the last member moves to its slot.
  void remove(std::uint32_t v) {
    Array<std::uint32_t>& members = classes_[class_of(v)];
    const std::uint32_t last = members.back();
    members[slot_[v]] = last;
    slot_[last] = slot_[v];
    members.pop_back();
  }
  void change(std::uint32_t v, std::uint32_t edges) {
    if (std::min(edges, kMost) == class_of(v)) {
      edges_[v] = edges;
      return;
    }
    remove(v);
    edges_[v] = edges;
    insert(v);
  }
  void grow(std::uint32_t v) { change(v, edges_[v] + 1); }

  Array<std::uint32_t> edges_;  ///< of each vertex
  Array<std::uint32_t> slot_;   ///< by vertex, its slot in the class
  std::array<Array<std::uint32_t>, kMost + 1> classes_;
  BitTreeModel<kClassBits> class_;
};

}  // namespace mesher::progressive
