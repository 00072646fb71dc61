#pragma once

#include "engine/io/mapped_file.h"
#include "engine/io/obj_groups.h"
#include "engine/mesh/build/soup.h"

namespace mesher::io {

/// Limit on the material files that an OBJ may name.
inline constexpr std::size_t kMostMtlFiles = 64;

/// Returns the file names of the text after `mtllib`. Names may be quoted or have blanks in them;
/// where one could be several, each ends in ".mtl".
std::vector<std::string> mtl_file_names(std::string_view text);

/// Reads the material files of an OBJ with their images, sets Soup::materials, and makes the
/// materials of the groups indices of it.
///
/// Files in or below the OBJ's folder are opened; backslashes may separate folders. A file that is
/// missing or elsewhere gives a warning. A material that no file describes has only its name.
void add_materials(const MappedFile& obj, const ObjGroups& groups, Soup& soup);

}  // namespace mesher::io
