#pragma once

#include <cstddef>
#include <cstdint>

#include "engine/core/progress.h"
#include "engine/mesh/attributes.h"

namespace mesher::subdivide {

/// Returns the corner attributes of a subdivided mesh. They are interpolated linearly along edges
/// within each face, so that seams stay in place. Groups are copied to all children. Normals are
/// dropped, because they are not those of the new surface (`limit_normal` has those). O(faces of
/// the result), parallel. Throws Cancelled.
Attributes subdivide_attributes(const Attributes& attributes, std::uint32_t levels,
                                Progress* progress = nullptr);

/// Returns the number of bytes that subdivide_attributes needs: the result and the level before it.
/// O(1).
std::size_t subdivided_attribute_bytes(const Attributes& attributes, std::uint32_t levels);

}  // namespace mesher::subdivide
