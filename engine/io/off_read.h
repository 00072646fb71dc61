#pragma once

#include "engine/io/mapped_file.h"
#include "engine/mesh/soup.h"

namespace mesher {

/// Reads OFF as text, with the prefixes ST, C and N (texture coordinates, colours and normals of
/// vertices), comments and missing edge counts; colours of faces are passed over. Refuses binary,
/// four-dimensional and n-dimensional OFF. O(bytes); allocates no more than the bytes can say.
/// Throws InputError with the line.
Soup read_off(const MappedFile& file);

}  // namespace mesher
