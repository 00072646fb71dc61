#pragma once

#include <algorithm>
#include <span>

#include "engine/core/array.h"
#include "engine/mesh/ids.h"

namespace mesher {

/// One copy of a bow-tie vertex. A bow-tie vertex is a vertex of the input where several fans of
/// faces meet that no edge of the input joins. A mesh is a manifold, so `build_mesh` gives each fan
/// a vertex of its own: these are the copies. Simplification and subdivision pin them, so that the
/// surfaces still meet there (OpenSubdiv makes such vertices infinitely sharp, too).
struct BowTieCopy {
  Vertex v;
  Vertex first;  ///< the lowest of the copies of the same bow-tie vertex
  friend bool operator==(const BowTieCopy&, const BowTieCopy&) = default;
};

/// Restores invariant 13 of Mesh: sorts the list, drops copies that are the only one left of their
/// vertex, and names the first of each vertex. O(k log k).
/// Pre: no `v` twice; copies of the same vertex, and no others, agree in `first`, whatever it is.
void normalize(Array<BowTieCopy>& copies);

/// Returns the list with the ids that `new_id(Vertex)` gives. It gives none (an invalid id) to
/// vertices that are no copies any more. O(k log k). Pre: `new_id` gives no id twice.
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
