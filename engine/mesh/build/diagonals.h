#pragma once

#include <cstdint>
#include <vector>

#include "engine/mesh/build/edge_matching.h"
#include "engine/mesh/mesh.h"

namespace mesher {

/// The two half-edges of a diagonal, one in each of the triangles that it separates.
struct Diagonal {
  Halfedge a;
  Halfedge b;
};

/// Returns the diagonals of triangulated polygons that coincide with another edge. Two polygons
/// that share several vertices may have been cut along the same pair of vertices, or along an edge
/// of a third polygon, so that a clean quad mesh would become non-manifold. The other diagonal of
/// the two triangles avoids that. Returns at most one diagonal per face, and none if both triangles
/// have the same third vertex. `polygon_of` maps each triangle to its polygon. O(faces at edges of
/// three and more faces). Internal to building.
std::vector<Diagonal> crowded_diagonals(const Array<Vertex>& origin, const EdgeMatching& matching,
                                        const Array<std::uint32_t>& polygon_of);

/// Flips a diagonal in an array of values per corner (vertices, attributes): triangles (a b c) and
/// (b a d) become (a d c) and (b c d). Does nothing to an empty array.
template <class T>
void flip_diagonal(const Diagonal& diagonal, Array<T>& values) {
  if (values.empty()) return;
  values[Mesh::next(diagonal.a).index()] = T(values[Mesh::prev(diagonal.b).index()]);
  values[Mesh::next(diagonal.b).index()] = T(values[Mesh::prev(diagonal.a).index()]);
}

}  // namespace mesher
