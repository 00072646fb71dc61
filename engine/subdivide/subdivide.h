#pragma once

#include <cstdint>
#include <glm/vec3.hpp>

#include "engine/core/array.h"
#include "engine/mesh/mesh.h"
#include "engine/subdivide/options.h"

namespace mesher::subdivide {

/// The size of a subdivision, known in advance.
struct SubdivisionSize {
  std::uint64_t vertices = 0;
  std::uint64_t faces = 0;
  std::uint64_t result_bytes = 0;  ///< the finished mesh, with limit normals if requested
  std::uint64_t peak_bytes = 0;    ///< the peak during the work, without the input
  bool has_ids = true;             ///< all ids fit in 32 bits
};

/// Returns the size that a subdivision will have. O(F), to count the edges.
SubdivisionSize subdivision_size(const Mesh& mesh, const SubdivideOptions& options);

/// A subdivided mesh.
struct Subdivided {
  Mesh mesh;
  /// Unit normals of the limit surface, one per half-edge (for its corner), so that creases split
  /// them; empty unless the limit was requested.
  Array<glm::vec3> limit_normal;
};

/// Returns the mesh with every face split into four, `levels` times. Old vertices come first, then
/// one vertex per edge in the order in which a walk over faces 0..F-1 and their edges ab, bc, ca
/// first visits them. The children of face (a, b, c) are (a, ab, ca), (ab, b, bc), (ca, bc, c),
/// (ab, bc, ca), at 4f .. 4f+3. Child edges inherit the remaining sharpness. Boundary edges are
/// permanently sharp; an isolated vertex keeps its position. The result is the same, to the byte,
/// for any number of threads. O(faces of the result). Throws Cancelled. Pre: the mesh is valid, its
/// size has ids.
[[nodiscard]] Subdivided subdivide(const Mesh& mesh, const SubdivideOptions& options);

/// A mesh for renderers and exporters, without half-edges.
struct IndexedTriangles {
  Array<glm::vec3> position;  ///< V, model units
  Array<Vertex> index;        ///< 3F
};

/// Returns the same positions and faces as `subdivide`, without connectivity on the last level, in
/// about two thirds of the time.
[[nodiscard]] IndexedTriangles subdivide_to_triangles(const Mesh& mesh,
                                                      const SubdivideOptions& options);

}  // namespace mesher::subdivide
