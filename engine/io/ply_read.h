#pragma once

#include "engine/core/progress.h"
#include "engine/io/mapped_file.h"
#include "engine/mesh/build/soup.h"

namespace mesher::io {

/// Reads PLY: text and both binary encodings, values of any type, list counts of any integer type,
/// elements in any order.
///
/// Reads positions, normals, colors and texture coordinates of vertices; polygons (`vertex_indices`
/// or `vertex_index`) with texture coordinates per corner (`texcoord`) and colors; and triangle
/// strips. A face's color goes to its corners. Textures are read in MeshLab's way
/// (engine/io/ply_textures.h). A `texcoord` list of another length costs its face the texture
/// coordinates, with a warning. Everything else is only named among the contents.
/// Coordinates far from zero, as text or doubles, are read again about an origin (`choose_origin`).
///
/// This reader is our own for two reasons: it checks counts against the available bytes before it
/// allocates, and it preserves every bit of a value. O(bytes). Throws InputError, with the line in
/// text files.
Soup read_ply(const MappedFile& file, Progress* progress = nullptr);

}  // namespace mesher::io
