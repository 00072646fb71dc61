#pragma once

#include "engine/core/progress.h"
#include "engine/io/mapped_file.h"
#include "engine/mesh/build/soup.h"

namespace mesher::io {

/// Reads STL, binary or text. A file of exactly the size of its binary facet count is binary. Any
/// other file is text if it begins with "solid", and binary if not.
///
/// STL lists three positions per triangle. Bitwise equal positions (0 and -0 count as equal) become
/// one vertex, in the order of first appearance. Normals, which follow from the positions, and
/// vendor-specific attribute bytes are ignored. This reader is our own because libraries return
/// unconnected triangles. O(n log n) time. Throws InputError.
Soup read_stl(const MappedFile& file, Progress* progress = nullptr);

}  // namespace mesher::io
