#pragma once

#include "engine/io/mapped_file.h"
#include "engine/mesh/soup.h"

namespace mesher {

/// Reads STL, binary or text (told apart by whether the size fits the binary count). STL lists
/// three positions a triangle; positions that are bitwise equal (0 and -0 count as equal) become
/// one vertex, in the order of their first appearance. Normals, which follow from the positions,
/// and other vendors' attribute bytes are passed over. Ours rather than a library's: those hand on
/// the unconnected triangles. O(n log n) time. Throws InputError.
Soup read_stl(const MappedFile& file);

}  // namespace mesher
