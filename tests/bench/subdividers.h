#pragma once

#include <memory>
#include <span>
#include <string_view>

#include "engine/mesh/mesh.h"
#include "engine/mesh/soup.h"
#include "engine/subdivide/subdivide.h"

namespace mesher::bench {

/// What is to be subdivided, and how large that gets.
struct SubdivisionWork {
  Soup soup;  ///< triangles and creases; no vertex that no face uses
  SubdivideOptions options;
  SubdivisionSize size;
};

/// What comes of it; one of them is filled.
struct SubdivisionOutcome {
  IndexedTriangles triangles;
  Mesh mesh;
  std::shared_ptr<void> memory;
};

/// Somebody's Loop subdivision: positions and corners of triangles in, those of the last level out.
/// Conversion into its own structures, and their end, are part of the work.
using SubdivideArrays = SubdivisionOutcome (*)(SubdivisionWork&& work);

/// Half-edge building and all threads included.
SubdivisionOutcome subdivide_ours(SubdivisionWork&& work);
SubdivisionOutcome subdivide_ours_one_thread(SubdivisionWork&& work);
/// To a whole half-edge mesh, ready for the next edit.
SubdivisionOutcome subdivide_ours_to_mesh(SubdivisionWork&& work);
SubdivisionOutcome subdivide_ours_to_mesh_one_thread(SubdivisionWork&& work);
/// Far: uniform refinement of the topology, then of the positions level by level. Needs DeRose's
/// crease rules.
SubdivisionOutcome subdivide_opensubdiv(SubdivisionWork&& work);
/// No creases. Pre: closed.
SubdivisionOutcome subdivide_openmesh(SubdivisionWork&& work);

/// The least that anybody must do: plain stores to all bytes of the output's arrays, in fresh
/// memory of small pages. Giving it back is not counted.
SubdivisionOutcome fill_small_pages(SubdivisionWork&& work);
/// The same in the arrays that ours are written to, on huge pages where the system grants them.
SubdivisionOutcome fill_arrays(SubdivisionWork&& work);

// One level of splitting alone, edges halved, nothing else moved, one thread: how the two faces of
// an edge find their common vertex.

/// From half-edges that are at hand, by arithmetic. `mesh`: that of the soup.
IndexedTriangles split_by_arithmetic(const Mesh& mesh);
/// From triangles, as textbooks have it: a hash table from pairs of vertices to the new one.
/// `is_reserved`: with its buckets reserved, the number of edges guessed well.
IndexedTriangles split_by_hashing(const Soup& soup, bool is_reserved);

}  // namespace mesher::bench
