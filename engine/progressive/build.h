#pragma once

#include <span>

#include "engine/core/array.h"
#include "engine/core/progress.h"
#include "engine/mesh/attributes.h"
#include "engine/mesh/mesh.h"
#include "engine/progressive/progressive_attributes.h"
#include "engine/progressive/progressive_mesh.h"
#include "engine/simplify/observer.h"
#include "engine/simplify/options.h"
#include "engine/simplify/report.h"

namespace mesher::progressive {

/// A progressive mesh and the source of each vertex and face.
struct Progressive {
  ProgressiveMesh mesh;         ///< at its base
  Array<Vertex> vertex_source;  ///< by vertex of the full mesh, the input's vertex
  /// By face, the half-edge of the input that became its first half-edge. Corners may be rotated,
  /// so that the edge that opens in a split comes first.
  Array<Halfedge> face_source;
  simplify::SimplifyReport report;   ///< of the simplification to the base
  ProgressiveAttributes attributes;  ///< at the base
};

/// Turns the collapses recorded by `simplify` into splits. Sorts them by rank first, so that each
/// level is close to what simplification to its size would yield. At full detail the arrays equal
/// the input's bit for bit, with mapped ids. O(F + collapses). Throws Cancelled. Pre: `collapses`
/// were recorded on `full` and end at the base.
Progressive build_progressive(const Mesh& full, std::span<const simplify::CollapseRecord> collapses,
                              Progress* progress = nullptr);

/// Simplifies a copy of the mesh by `options` and makes a progressive mesh of the collapses. Does
/// not notify the observer of `options`. Throws Cancelled. Pre: the mesh is valid.
Progressive make_progressive(const Mesh& full, const simplify::SimplifyOptions& options);

/// Same, with the attributes of the mesh: collapses go along seams as `simplify_model` describes,
/// attributes count in their costs by the options' weights, and every level has values of its own.
/// The base may have more faces than asked for, since seams are not crossed.
Progressive make_progressive(const Mesh& full, const Attributes& attributes,
                             const simplify::SimplifyOptions& options);

}  // namespace mesher::progressive
