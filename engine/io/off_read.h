#pragma once

#include "engine/core/progress.h"
#include "engine/io/mapped_file.h"
#include "engine/mesh/build/soup.h"

namespace mesher::io {

/// Reads text OFF.
///
/// Supports the prefixes ST, C and N (texture coordinates, colors and normals of vertices) in any
/// order, comments and missing edge counts. Three or four numbers after a face, or after a vertex
/// that the prefixes do not explain, are its color; other numbers are only noted. A face's color
/// goes to its corners. Coordinates far from zero are read again in double precision, about an
/// origin (`choose_origin`). Refuses binary, four-dimensional and n-dimensional OFF. O(bytes);
/// allocates no more than the file's bytes justify. Throws InputError with the line.
Soup read_off(const MappedFile& file, Progress* progress = nullptr);

}  // namespace mesher::io
