#pragma once

#include "engine/mesh/mesh.h"
#include "engine/simplify/attribute_metric.h"
#include "engine/simplify/observer.h"
#include "engine/simplify/options.h"
#include "engine/simplify/report.h"

namespace mesher::simplify {

/// A simplified mesh, its report, and the source of each vertex and face.
struct Simplified {
  Mesh mesh;
  SimplifyReport report;
  Array<Vertex> vertex_source;  ///< by id in the result, the id in the input
  Array<Face> face_source;  ///< by id in the result, the id in the input; corners keep their order
  CornerVectors corners;    ///< empty if SimplifyOptions::metric is null
};

/// Simplifies a mesh by edge collapse. The cheapest legal edge goes first, up to a tolerance that
/// makes the work parallel and local (docs/efficiency.md). Every step leaves an oriented manifold
/// with the components, Euler characteristic and boundary loops of the input. Faces that turn or
/// fold and parts that retreat count as errors (appraisal.h). The same input and options yield the
/// same bytes for any number of threads.
///
/// Pre: the mesh is valid. O(F log F) time. Consumes the mesh to reuse its memory (at most 160
/// bytes per face in total). `no_intersections` without an observer keeps one copy of the mesh,
/// `max_error` and `certifies` keep two, at 24 to 56 bytes per face each. Throws Cancelled.
[[nodiscard]] Simplified simplify(Mesh&& mesh, const SimplifyOptions& options);

}  // namespace mesher::simplify
