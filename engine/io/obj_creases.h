#pragma once

#include <optional>
#include <vector>

#include "engine/io/mapped_file.h"
#include "engine/io/obj_chunk.h"
#include "engine/mesh/build/soup.h"

namespace mesher::io {

/// Adds the creases and corners of an OBJ file to its soup.
///
/// `e` lines count vertices from `base`. If it is not set, the base is the one for which more pairs
/// are edges of faces; 0 if both give the same number. O(corners) if the base must be determined.
/// Throws InputError with the line of a vertex that does not exist.
void add_obj_tags(const MappedFile& file, std::optional<int> base, const std::vector<ObjTag>& tags,
                  Soup& soup);

}  // namespace mesher::io
