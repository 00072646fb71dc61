#pragma once

#include "engine/core/progress.h"
#include "engine/mesh/attributes.h"
#include "engine/mesh/build/report.h"
#include "engine/mesh/build/soup.h"
#include "engine/mesh/mesh.h"

namespace mesher {

struct BuildOptions {
  /// Keep vertices that no face uses. Dropped by default, because an isolated point is not a
  /// surface.
  bool keep_isolated_vertices = false;
  Progress* progress = nullptr;
};

struct BuildResult {
  Mesh mesh;
  Attributes attributes;  ///< at the corners of `mesh`
  BuildReport report;
  /// For each vertex of the mesh, its index in Soup::positions. Increasing, except for the copies
  /// made for second sides and by cutting, which come last.
  Array<std::uint32_t> vertex_source;
};

/// Returns a manifold, oriented half-edge mesh of any polygon soup, and counts the repairs. In this
/// order:
///
/// - Polygons are triangulated (`triangulate`).
/// - Faces are dropped if they are degenerate, use a non-finite vertex or repeat an earlier face
/// with
///   the same direction and group. One with the vertices of an earlier face but another direction
///   or group was modeled on purpose: it is kept as a second side, on vertices of its own.
/// - Neighbors that disagree in orientation are flipped to agree with the majority of their
///   component.
/// - Edges of more than two faces are cut. Around each, faces that bound the same solid are paired
///   again (A. Gueziec et al., "Converting sets of polygons to manifold surfaces by cutting and
///   stitching", 1998).
/// - One-sided surfaces are cut along the edges where they cannot be oriented.
/// - Vertices where several fans meet are split.
///
/// A clean soup keeps its order of faces, corners and vertices.
///
/// O(F + V) expected, parallel (half-edges are chained by vertex without hashing; a chain of k is
/// sorted in O(k log k)). The result is the same for any number of threads. Scratch memory: about 8
/// bytes per face. Throws InputError if an index is out of range or ids do not fit in 32 bits.
[[nodiscard]] BuildResult build_mesh(Soup&& soup, const BuildOptions& options = {});

}  // namespace mesher
