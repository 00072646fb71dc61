#pragma once

#include "engine/io/atomic_file.h"
#include "engine/mesh/attributes.h"
#include "engine/mesh/mesh.h"

namespace mesher {

/// Writes Wavefront OBJ: `v` (with colour where each vertex has one colour), `vt` and `vn` without
/// repetition, `f`, groups as `g` in runs of faces, and creases as `e a b s`, counted from 0, with
/// a comment that says so; vertices with a sharpness of their own as `t corner`. Numbers are the
/// shortest that read back as the same floats. Does not commit. O(F log F) with attributes, else
/// O(F).
void write_obj(AtomicFile& file, const Mesh& mesh, const Attributes& attributes);

}  // namespace mesher
