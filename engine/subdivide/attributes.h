#pragma once

#include <cstddef>
#include <cstdint>

#include "engine/core/progress.h"
#include "engine/mesh/attributes.h"

namespace mesher {

/// Attributes of the corners of a subdivided mesh: linear along edges, within each face, so that
/// seams stay where they are. Groups go to all children. Normals are dropped: they are not those of
/// the new surface (`limit_normal` are). O(faces of the result), parallel.
/// Throws Cancelled.
Attributes subdivide_attributes(const Attributes& attributes, std::uint32_t levels,
                                Progress* progress = nullptr);

/// Bytes that they will take, and those of the level before beside them. O(1).
std::size_t subdivided_attribute_bytes(const Attributes& attributes, std::uint32_t levels);

}  // namespace mesher
