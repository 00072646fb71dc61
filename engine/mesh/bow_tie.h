#pragma once

#include <algorithm>
#include <span>

#include "engine/core/array.h"
#include "engine/mesh/ids.h"

namespace mesher {

/// One copy of a bow-tie vertex. A bow-tie vertex is a vertex of the input at which several fans of
/// faces meet without a common edge. A mesh is a manifold, so `build_mesh` gives each fan its own
/// vertex; these are the copies. Simplification and subdivision pin them, so that the surfaces
/// still meet there. (OpenSubdiv also makes such vertices infinitely sharp.)
struct BowTieCopy {
  Vertex v;
  Vertex first;  ///< the lowest copy of the same bow-tie vertex
  friend bool operator==(const BowTieCopy&, const BowTieCopy&) = default;
};

/// Restores invariant 13 of Mesh: sorts the list, drops copies that are the only one left of their
/// vertex, and sets `first`. O(k log k). Pre: no `v` occurs twice; two copies have the same
/// `first`, with any value, exactly if they are copies of the same vertex.
void normalize(Array<BowTieCopy>& copies);

/// Returns the list with every id replaced by `new_id(Vertex)`, which returns an invalid id for a
/// vertex that is no longer a copy. O(k log k). Pre: `new_id` returns no valid id twice.
template <class NewId>
Array<BowTieCopy> renamed(std::span<const BowTieCopy> copies, const NewId& new_id) {
  Array<BowTieCopy> result;
  for (const auto& [v, first] : copies) {
    if (const Vertex id = new_id(v); id.is_valid()) result.push_back({id, first});
  }
  normalize(result);
  return result;
}

}  // namespace mesher
