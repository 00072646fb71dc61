#pragma once

#include <cstdint>

#include "engine/mesh/mesh.h"
#include "engine/mesh/statistics.h"

namespace mesher::simplify {

/// Returns a coarse copy of a mesh with about `target_faces` faces, in one pass, to be shown while
/// the mesh itself would take too long to draw. Vertices in the same cell of a grid become one, at
/// their mean (J. Rossignac and P. Borrel, "Multi-resolution 3D approximations for rendering
/// complex scenes", 1993). A cell in which no face is left keeps an enlarged one, so that parts
/// smaller than a cell stay visible. Vertices move by at most the diagonal of a cell.
///
/// `statistics`: of the mesh. The number of faces is met within a factor of about 2 on smooth
/// surfaces; it is smaller for meshes whose faces are larger than the cells, and never more than
/// that of the mesh plus one per cell. O(V + F). Attributes and creases are not kept.
Mesh cluster(const Mesh& mesh, const Statistics& statistics, std::uint32_t target_faces);

}  // namespace mesher::simplify
