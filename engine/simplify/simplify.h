#pragma once

#include "engine/mesh/mesh.h"
#include "engine/simplify/observer.h"
#include "engine/simplify/options.h"
#include "engine/simplify/report.h"

namespace mesher {

/// A simplified mesh, what it took, and where its parts come from.
struct Simplified {
  Mesh mesh;
  SimplifyReport report;
  Array<Vertex> vertex_source;  ///< for each vertex the id that it had in the input
  Array<Face> face_source;      ///< for each face the same; its corners are in the same order
};

/// Simplifies a mesh by edge collapse: the cheapest legal edge goes first, up to a tolerance that
/// makes the work parallel and local (docs/efficiency.md). Every step leaves an oriented manifold
/// with the components, Euler characteristic and boundary loops of the input. Faces that turn or
/// fold and parts that retreat count as errors (appraisal.h). The same input and options give the
/// same bytes for any number of threads. O(F log F) time; takes the mesh over, so that its memory
/// is used again (at most 160 bytes per face in all). `no_intersections` without an observer keeps
/// one copy of the mesh, `max_error` and `certifies` two, 24 to 56 bytes per face each. Throws
/// Cancelled. Pre: the mesh is valid.
[[nodiscard]] Simplified simplify(Mesh&& mesh, const SimplifyOptions& options);

}  // namespace mesher
