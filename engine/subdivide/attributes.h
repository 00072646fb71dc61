#pragma once

#include <cstddef>

#include "engine/mesh/attributes.h"
#include "engine/mesh/mesh.h"
#include "engine/subdivide/options.h"

namespace mesher::subdivide {

/// Returns the attributes of a subdivided mesh. Texture coordinates follow `SubdivideOptions::uv`;
/// if it is smooth, see subdivide_charts. Other numbers are interpolated linearly along edges
/// within each face, so that seams stay in place. A new vertex follows the joints of both ends of
/// its edge (JointSum). Other integers that are no fractions are those of the end with the lower
/// wedge. Groups are copied to all children. Normals are those of the new surface, split where the
/// old ones are and at creases. Tangents are dropped. `fine` is `coarse` subdivided with these
/// options. O(faces of the result), parallel. Throws Cancelled.
Attributes subdivide_attributes(const Mesh& coarse, const Attributes& attributes, const Mesh& fine,
                                const SubdivideOptions& options);

/// Returns the number of bytes that subdivide_attributes needs at most: values per corner, those of
/// the level before, and the charts of smooth texture coordinates. O(1).
std::size_t subdivided_attribute_bytes(const Mesh& coarse, const Attributes& attributes,
                                       const SubdivideOptions& options);

}  // namespace mesher::subdivide
