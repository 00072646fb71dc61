#pragma once

#include <cstdint>
#include <vector>

#include "engine/mesh/edge_matching.h"
#include "engine/mesh/mesh.h"

namespace mesher {

/// The two half-edges of a diagonal, one in each of the triangles that it separates.
struct Diagonal {
  Halfedge a;
  Halfedge b;
};

/// Diagonals of cut polygons that coincide with another edge: two polygons that share several
/// vertices may have been cut along the same pair, or along an edge of a third, and a clean mesh of
/// quads would come out non-manifold. The other diagonal of the two triangles is free of that. At
/// most one diagonal a face; none where both triangles have the same third vertex. `polygon_of`
/// names the polygon that each triangle was cut from. O(faces at crowded edges). Internal to
/// building.
std::vector<Diagonal> crowded_diagonals(const Array<Vertex>& origin, const EdgeMatching& matching,
                                        const Array<std::uint32_t>& polygon_of);

/// Flips a diagonal in an array of values a corner (vertices, attributes): triangles (a b c) and
/// (b a d) become (a d c) and (b c d). Does nothing to an empty array.
template <class T>
void flip_diagonal(const Diagonal& diagonal, Array<T>& values) {
  if (values.empty()) return;
  values[Mesh::next(diagonal.a).index()] = T(values[Mesh::prev(diagonal.b).index()]);
  values[Mesh::next(diagonal.b).index()] = T(values[Mesh::prev(diagonal.a).index()]);
}

}  // namespace mesher
