#pragma once

#include <algorithm>
#include <cstdint>
#include <span>

#include "engine/core/array.h"
#include "engine/mesh/circulators.h"
#include "engine/mesh/mesh.h"

namespace mesher::progressive {

/// The half-edges out of a parent, counterclockwise from outgoing(parent), and whether their faces
/// close around it. They are in slots 0 to k-1 (see SplitCut).
struct ParentFan {
  std::span<const Halfedge> out;
  bool is_closed = false;

  std::uint32_t size() const { return static_cast<std::uint32_t>(out.size()); }
  /// Return the halves of the edge in a slot; either may be none.
  Halfedge out_of(std::uint32_t slot) const { return slot < size() ? out[slot] : Halfedge{}; }
  Halfedge into(std::uint32_t slot) const {
    if (slot == 0) return is_closed ? Mesh::prev(out.back()) : Halfedge{};
    return Mesh::prev(out[slot - 1]);
  }
  /// Returns the slot of a half-edge out of the parent, or size() for any other. O(valence).
  std::uint32_t slot_of(Halfedge h) const {
    return static_cast<std::uint32_t>(std::find(out.begin(), out.end(), h) - out.begin());
  }
};

/// Returns the fan around a vertex. It refers to `memory`, which is reused. O(valence). Pre: not
/// isolated.
inline ParentFan gather_fan(const Mesh& mesh, Vertex v, Array<Halfedge>& memory) {
  memory.clear();
  Circulator at(mesh, mesh.outgoing(v));
  do {
    memory.push_back(*at);
  } while (at.advance());
  return {memory, at.is_closed()};
}

}  // namespace mesher::progressive
