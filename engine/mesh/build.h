#pragma once

#include "engine/core/progress.h"
#include "engine/mesh/attributes.h"
#include "engine/mesh/mesh.h"
#include "engine/mesh/report.h"
#include "engine/mesh/soup.h"

namespace mesher {

struct BuildOptions {
  /// Keep vertices that no face uses (an isolated point is not a surface: dropped by default).
  bool keep_isolated_vertices = false;
  Progress* progress = nullptr;
};

struct BuildResult {
  Mesh mesh;
  Attributes attributes;  ///< carried to the corners of `mesh`
  BuildReport report;
  /// For each vertex of the mesh, its index in Soup::positions. Increasing but for the copies that
  /// cutting made, which come last.
  Array<std::uint32_t> vertex_source;
};

/// Makes a manifold, oriented half-edge mesh of any soup of polygons, and counts what had to be
/// repaired. In order: polygons are triangulated (`triangulate`); faces that are degenerate, use a
/// non-finite vertex or repeat an earlier face are dropped; neighbours that disagree in orientation
/// are turned to agree with the majority of their component; an edge of more than two faces is cut
/// apart, its faces paired again around the edge where they bound the same solid (A. Gueziec et
/// al., "Converting sets of polygons to manifold surfaces by cutting and stitching", 1998);
/// one-sided surfaces are cut where they cannot agree; vertices where several fans meet are split.
/// A clean soup keeps its order of faces, corners and vertices.
///
/// Time O(F + V) expected (chains by vertex, no hashing; a chain of k is sorted in O(k log k)),
/// in parallel; result the same for any number of threads. Scratch about 8 bytes a face. Throws
/// InputError where an index is out of range or there are too many faces for 32-bit ids.
[[nodiscard]] BuildResult build_mesh(Soup&& soup, const BuildOptions& options = {});

}  // namespace mesher
