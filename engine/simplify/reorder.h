#pragma once

#include "engine/core/array.h"
#include "engine/mesh/mesh.h"

namespace mesher {

/// A mesh with its vertices and faces in another order.
struct Reordered {
  Mesh mesh;
  Array<Vertex> vertex_source;  ///< for each vertex the id that it had
  Array<Face> face_source;      ///< for each face the same; corners keep their order
};

/// Vertices along a Morton curve, faces by their first vertex there: what is near on the surface is
/// near in memory, whatever order a file had (meshoptimizer's time on 2 million triangles halves
/// from shuffled to ordered). O(V + F), parallel.
Reordered reorder_by_position(const Mesh& mesh);

/// Which vertices and faces of a mesh with holes are left, and where each goes.
struct KeptIds {
  Array<Vertex> vertices;  ///< by new id, the old id
  Array<Face> faces;
};

/// A mesh of what is kept alone, in that order. Copies of bow-tie vertices are those that kept
/// their ids. O(V + F), parallel.
Mesh compact(const Mesh& mesh, const KeptIds& kept);

}  // namespace mesher
