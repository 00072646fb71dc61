#pragma once

#include <algorithm>
#include <cstdint>

#include "engine/core/array.h"
#include "engine/mesh/mesh.h"
#include "engine/progressive/vertex_split.h"

namespace mesher {

/// Returns the fan around a vertex. It refers to `memory`, which is reused.
inline ParentFan gather_fan(const Mesh& mesh, Vertex v, Array<Halfedge>& memory) {
  memory.clear();
  const Halfedge start = mesh.outgoing(v);
  Halfedge h = start;
  do {
    memory.push_back(h);
    h = mesh.rotate_ccw(h);
  } while (h.is_valid() && h != start);
  return {memory, h.is_valid()};
}

/// A parent's fan with both halves of the edge in each slot (see SplitCut); either half may be
/// none.
struct ParentSlots : ParentFan {
  explicit ParentSlots(const ParentFan& fan) : ParentFan(fan) {}

  std::uint32_t size() const { return static_cast<std::uint32_t>(out.size()); }
  Halfedge out_of(std::uint32_t slot) const { return slot < size() ? out[slot] : Halfedge{}; }
  Halfedge into(std::uint32_t slot) const {
    if (slot == 0) return is_closed ? Mesh::prev(out.back()) : Halfedge{};
    return Mesh::prev(out[slot - 1]);
  }
  std::uint32_t slot_of(Halfedge h) const {
    return static_cast<std::uint32_t>(std::find(out.begin(), out.end(), h) - out.begin());
  }
};

}  // namespace mesher
