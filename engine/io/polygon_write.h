#pragma once

#include "engine/core/progress.h"
#include "engine/io/atomic_file.h"
#include "engine/io/write.h"
#include "engine/mesh/attributes.h"
#include "engine/mesh/mesh.h"

namespace mesher::io {

// None of these functions commits the file. They report progress and throw Cancelled. All are O(F)
// and write in blocks, so memory does not grow with the mesh, except for attributes. Numbers in
// text are the shortest that read back as the same floats. `origin` is added to every position.

/// Writes PLY, little-endian binary or text. Normals, texture coordinates and colors are written
/// per vertex if all corners of each vertex agree. Texture coordinates with seams are written as
/// the faces' `texcoord` list. Positions are doubles unless `origin` is 0. Base color textures are
/// written in MeshLab's way (engine/io/ply_textures.h), with their images beside the file.
void write_ply(AtomicFile& file, const Mesh& mesh, const Attributes& attributes,
               const WriteOptions& options);

/// Writes STL, binary or text, with face normals.
/// Positions are those about zero in single precision, the only one of the format.
void write_stl(AtomicFile& file, const Mesh& mesh, const glm::dvec3& origin, bool ascii,
               Progress* progress = nullptr);

/// Writes OFF, or COFF if all corners of each vertex have one color.
void write_off(AtomicFile& file, const Mesh& mesh, const Attributes& attributes,
               const glm::dvec3& origin, Progress* progress = nullptr);

}  // namespace mesher::io
