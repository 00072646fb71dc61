#pragma once

#include <cstdint>
#include <glm/vec3.hpp>

#include "engine/core/array.h"
#include "engine/mesh/mesh.h"
#include "engine/subdivide/options.h"

namespace mesher {

/// How large a subdivision gets, known before any work is done.
struct SubdivisionSize {
  std::uint64_t vertices = 0;
  std::uint64_t faces = 0;
  std::uint64_t result_bytes = 0;  ///< of the finished mesh, with the normals of its limit
  std::uint64_t peak_bytes = 0;    ///< while it is made, without the input
  bool has_ids = true;             ///< every half-edge has an id of 32 bits
};

/// What a subdivision will take. O(F) for the number of edges.
SubdivisionSize subdivision_size(const Mesh& mesh, const SubdivideOptions& options);

/// A subdivided mesh.
struct Subdivided {
  Mesh mesh;
  /// Unit normals of the limit surface, one a half-edge (for its corner), so that creases split
  /// them; empty unless the limit was asked for.
  Array<glm::vec3> limit_normal;
};

/// Splits every face in four, `levels` times. Old vertices come first, then one vertex an edge in
/// the order met when walking faces 0..F-1 and their edges ab, bc, ca. The children of face
/// (a, b, c) are (a, ab, ca), (ab, b, bc), (ca, bc, c), (ab, bc, ca), at 4f .. 4f+3. Sharpness goes
/// to the child edges, as much of it as is left. Boundary edges are sharp for ever; an isolated
/// vertex stays where it is. The same bytes for any number of threads.
/// O(faces of the result). Throws Cancelled. Pre: the mesh is valid, its size has ids.
[[nodiscard]] Subdivided subdivide(const Mesh& mesh, const SubdivideOptions& options);

/// What a renderer or an exporter needs of a mesh, without its half-edges.
struct IndexedTriangles {
  Array<glm::vec3> position;  ///< V, model units
  Array<Vertex> index;        ///< 3F
};

/// The same positions and faces as `subdivide`, without connectivity on the last level: in about
/// two thirds of the time.
[[nodiscard]] IndexedTriangles subdivide_to_triangles(const Mesh& mesh,
                                                      const SubdivideOptions& options);

}  // namespace mesher
