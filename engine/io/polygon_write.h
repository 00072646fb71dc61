#pragma once

#include "engine/io/atomic_file.h"
#include "engine/mesh/attributes.h"
#include "engine/mesh/mesh.h"

namespace mesher {

// None of these commits the file. All O(F), in blocks: memory does not grow with the mesh, but for
// attributes. Text numbers are the shortest that read back as the same floats.

/// Writes PLY, little-endian binary or text: positions, and normals, texture coordinates and
/// colours of vertices where all corners of each vertex agree; texture coordinates with seams as
/// the faces' `texcoord` list.
void write_ply(AtomicFile& file, const Mesh& mesh, const Attributes& attributes, bool ascii);

/// Writes STL, binary or text, with face normals.
void write_stl(AtomicFile& file, const Mesh& mesh, bool ascii);

/// Writes OFF, or COFF where all corners of each vertex have one colour.
void write_off(AtomicFile& file, const Mesh& mesh, const Attributes& attributes);

}  // namespace mesher
