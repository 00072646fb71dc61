#pragma once

#include "engine/io/mapped_file.h"
#include "engine/mesh/soup.h"

namespace mesher {

/// Reads STL, binary or text. The format is binary if the file size fits the binary facet count.
///
/// STL lists three positions per triangle. Bitwise equal positions (0 and -0 count as equal) become
/// one vertex, in the order of first appearance. Normals, which follow from the positions, and
/// vendor-specific attribute bytes are ignored. This reader is our own because libraries return
/// unconnected triangles. O(n log n) time. Throws InputError.
Soup read_stl(const MappedFile& file);

}  // namespace mesher
