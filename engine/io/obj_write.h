#pragma once

#include "engine/io/atomic_file.h"
#include "engine/io/write.h"
#include "engine/mesh/attributes.h"
#include "engine/mesh/mesh.h"

namespace mesher::io {

/// Writes Wavefront OBJ.
///
/// Writes `v` (with color if each vertex has one color), `vt` and `vn` without duplicates, `f`,
/// groups as `o`, `g`, `s` and `usemtl` in runs of faces, and creases as `e a b s`. Creases count
/// vertices from 0, and a comment in the file says so. Vertices with a sharpness of their own are
/// written as `t corner`. Numbers are the shortest that read back as the same floats; the origin is
/// added to positions. Materials go to an MTL file beside, with their images
/// (engine/io/mtl_write.h). Does not commit. O(F log F) with attributes, else O(F).
void write_obj(AtomicFile& file, const Mesh& mesh, const Attributes& attributes,
               const WriteOptions& options);

}  // namespace mesher::io
