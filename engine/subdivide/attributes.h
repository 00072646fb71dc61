#pragma once

#include <cstdint>

#include "engine/mesh/attributes.h"

namespace mesher {

/// Attributes of the corners of a subdivided mesh: linear along edges, within each face, so that
/// seams stay where they are. Groups go to all children. Normals are dropped: they are not those of
/// the new surface (`limit_normal` are). O(faces of the result), parallel.
Attributes subdivide_attributes(const Attributes& attributes, std::uint32_t levels);

}  // namespace mesher
