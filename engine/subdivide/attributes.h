#pragma once

#include <cstddef>
#include <cstdint>

#include "engine/core/progress.h"
#include "engine/mesh/attributes.h"
#include "engine/mesh/mesh.h"

namespace mesher::subdivide {

/// Returns the attributes of a subdivided mesh. Numbers are interpolated linearly along edges
/// within each face, so that seams stay in place. The bones of a new vertex, and other integers
/// that are no fractions, are those of the end with the lower wedge. Groups are copied to all
/// children. Normals are those of the new surface, split where the old ones are and at creases.
/// Tangents are dropped. `fine` is `coarse` after `levels` levels. O(faces of the result),
/// parallel. Throws Cancelled.
Attributes subdivide_attributes(const Mesh& coarse, const Attributes& attributes, const Mesh& fine,
                                std::uint32_t levels, Progress* progress = nullptr);

/// Returns the number of bytes that subdivide_attributes needs at most: values per corner, and
/// those of the level before. O(1).
std::size_t subdivided_attribute_bytes(const Mesh& coarse, const Attributes& attributes,
                                       std::uint32_t levels);

}  // namespace mesher::subdivide
