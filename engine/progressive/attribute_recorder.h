#pragma once

#include "engine/core/progress.h"
#include "engine/mesh/attributes.h"
#include "engine/mesh/mesh.h"
#include "engine/progressive/progressive_attributes.h"
#include "engine/progressive/progressive_mesh.h"

namespace mesher::progressive {

/// Returns the attributes of a progressive mesh at its base. At full detail they are those of the
/// input, bit for bit, with mapped ids. Each merged vertex gets the values of `store_merged`, on
/// each side of a line of the input (simplify::Lines); values that differ elsewhere, such as the
/// normals of soft edges, are averaged once their vertex is merged. Leaves `mesh` at its base. O(F
/// * values). Throws Cancelled.
///
/// Pre: `attributes` are those of `full`; `face_source` as in Progressive.
ProgressiveAttributes record_attributes(ProgressiveMesh& mesh, const Mesh& full,
                                        std::span<const Halfedge> face_source,
                                        const Attributes& attributes, Progress* progress = nullptr);

}  // namespace mesher::progressive
