#pragma once

#include "engine/core/progress.h"
#include "engine/io/mapped_file.h"
#include "engine/mesh/build/soup.h"

namespace mesher::io {

/// Reads text OFF.
///
/// Supports the prefixes ST, C and N (texture coordinates, colors and normals of vertices),
/// comments and missing edge counts. Colors of faces are ignored. Refuses binary, four-dimensional
/// and n-dimensional OFF. O(bytes); allocates no more than the file's bytes justify. Throws
/// InputError with the line.
Soup read_off(const MappedFile& file, Progress* progress = nullptr);

}  // namespace mesher::io
