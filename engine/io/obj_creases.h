#pragma once

#include <optional>
#include <vector>

#include "engine/io/mapped_file.h"
#include "engine/io/obj_chunk.h"
#include "engine/mesh/soup.h"

namespace mesher {

/// Puts the creases and corners of an OBJ file into its soup. `e` lines count vertices from `base`;
/// where that is not said, from the base that makes more of the pairs edges of faces, 0 where both
/// make as many. O(corners) where the base must be decided. Throws InputError with the line of a
/// vertex that does not exist.
void add_obj_tags(const MappedFile& file, std::optional<int> base, const std::vector<ObjTag>& tags,
                  Soup& soup);

}  // namespace mesher
