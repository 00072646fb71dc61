#pragma once

#include "engine/io/mapped_file.h"
#include "engine/mesh/soup.h"

namespace mesher {

/// Reads PLY: text and both binary encodings, values of any type, list counts of any whole type,
/// elements in any order. Taken from it: positions, normals, colours and texture coordinates of
/// vertices; polygons (`vertex_indices` or `vertex_index`) with texture coordinates of their
/// corners
/// (`texcoord`); triangle strips. Everything else is passed over.
///
/// Ours rather than a library's, because counts are checked against the bytes that are there before
/// anything is allocated, and values keep every bit. O(bytes). Throws InputError, with the line in
/// text files.
Soup read_ply(const MappedFile& file);

}  // namespace mesher
