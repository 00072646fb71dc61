#pragma once

#include "engine/core/progress.h"
#include "engine/io/mapped_file.h"
#include "engine/mesh/build/soup.h"

namespace mesher::io {

/// Reads STL, binary or text. A file of exactly the size of its binary facet count is binary. Any
/// other file is text if it begins with "solid", and binary if not. If the size of a binary file is
/// that of some number of facets, a count in its header that differs is corrected and reported.
///
/// STL lists three positions per triangle, and the soup has a vertex for each; read_soup joins
/// them. Normals follow from the positions and are ignored; bad ones are counted. Binary facets
/// have colors by the convention of VisCAM or of Materialise Magics. O(bytes). Throws InputError.
Soup read_stl(const MappedFile& file, Progress* progress = nullptr);

}  // namespace mesher::io
