#pragma once

#include <span>

#include "engine/core/array.h"
#include "engine/core/progress.h"
#include "engine/mesh/mesh.h"
#include "engine/progressive/progressive_mesh.h"
#include "engine/simplify/observer.h"
#include "engine/simplify/options.h"
#include "engine/simplify/report.h"

namespace mesher {

/// A progressive mesh and where its parts come from.
struct Progressive {
  ProgressiveMesh mesh;         ///< at its base
  Array<Vertex> vertex_source;  ///< for each vertex of the full mesh the input's
  /// For each face the half-edge of the input that is its first: corners may be turned, so that the
  /// edge that opens in a split comes first.
  Array<Halfedge> face_source;
  SimplifyReport report;  ///< of the simplification that led to the base
};

/// Turns the collapses that `simplify` told of a mesh around into splits. They are sorted by rank
/// first, so that each level is about what simplification to its size would give. At full detail
/// the arrays are the input's bit for bit, ids mapped. O(F + collapses). Throws Cancelled. Pre:
/// `collapses` were recorded on `full` and end at the base.
Progressive build_progressive(const Mesh& full, std::span<const CollapseRecord> collapses,
                              Progress* progress = nullptr);

/// Simplifies a copy of the mesh as `options` say (whose observer is not told) and makes a
/// progressive mesh of what happened. Throws Cancelled. Pre: the mesh is valid.
Progressive make_progressive(const Mesh& full, const SimplifyOptions& options);

}  // namespace mesher
