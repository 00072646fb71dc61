#pragma once

#include <memory>
#include <span>
#include <string_view>

#include "engine/mesh/build/soup.h"
#include "engine/mesh/mesh.h"
#include "engine/subdivide/subdivide.h"

namespace mesher::bench {

/// The input of a subdivision and the size of its output.
struct SubdivisionWork {
  Soup soup;  ///< triangles and creases; every vertex is used by a face
  subdivide::SubdivideOptions options;
  subdivide::SubdivisionSize size;
};

/// The result of a subdivision; one of the members is filled.
struct SubdivisionOutcome {
  subdivide::IndexedTriangles triangles;
  Mesh mesh;
  std::shared_ptr<void> memory;
};

/// A Loop subdivision from arrays to arrays: positions and corners of triangles in, those of the
/// last level out. The measured time includes conversion to its own structures and their
/// destruction.
using SubdivideArrays = SubdivisionOutcome (*)(SubdivisionWork&& work);

/// Includes half-edge construction and all threads.
SubdivisionOutcome subdivide_ours(SubdivisionWork&& work);
SubdivisionOutcome subdivide_ours_one_thread(SubdivisionWork&& work);
/// Returns a complete half-edge mesh, ready for the next edit.
SubdivisionOutcome subdivide_ours_to_mesh(SubdivisionWork&& work);
SubdivisionOutcome subdivide_ours_to_mesh_one_thread(SubdivisionWork&& work);
/// Uses Far: uniform refinement of the topology, then of the positions level by level. Needs
/// DeRose's crease rules.
SubdivisionOutcome subdivide_opensubdiv(SubdivisionWork&& work);
/// No creases. Pre: closed.
SubdivisionOutcome subdivide_openmesh(SubdivisionWork&& work);

/// Lower bound for all contenders: plain stores to all bytes of the output arrays, in fresh memory
/// of small pages. The time to free it is not included.
SubdivisionOutcome fill_small_pages(SubdivisionWork&& work);
/// The same in the arrays that mesher writes, on huge pages where the system provides them.
SubdivisionOutcome fill_arrays(SubdivisionWork&& work);

// The next functions split each triangle once, at edge midpoints, without moving other vertices, on
// one thread. They compare how the two faces of an edge find their common vertex.

/// Computes the vertex from existing half-edges by arithmetic. `mesh`: the mesh of the soup.
subdivide::IndexedTriangles split_by_arithmetic(const Mesh& mesh);
/// Looks the vertex up in a hash table from vertex pairs, as in textbooks. `is_reserved`: with
/// reserved buckets, from a good estimate of the number of edges.
subdivide::IndexedTriangles split_by_hashing(const Soup& soup, bool is_reserved);

}  // namespace mesher::bench
