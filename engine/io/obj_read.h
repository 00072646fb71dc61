#pragma once

#include "engine/io/mapped_file.h"
#include "engine/io/read.h"
#include "engine/mesh/soup.h"

namespace mesher {

/// Reads Wavefront OBJ. The text is cut at line ends into chunks of a fixed size, which are parsed
/// in parallel, so the result does not depend on the number of threads.
///
/// Understood: `v` (with weight or colour), `vt`, `vn`, `f` in every index form, negative indices
/// and forward references included; `g`, `o`, `usemtl`, which together name the group of a face
/// ("object/group/material"); creases as `e a b [s]`, `t crease` and `t corner`; comments anywhere;
/// continuation lines; any line end but a lone carriage return, which is white space. Everything
/// else (points, lines, curves, materials) is passed over. Faces of fewer than three corners and
/// coordinates that are not finite pass through: `build_mesh` drops and counts them. Where only
/// some vertices have a colour, the others are white.
///
/// O(bytes); memory: the soup and a few megabytes. Throws InputError with the line for a malformed
/// number, an index that is zero or out of range, or a crease of vertices that do not exist, and
/// without one for a file that has no vertices or more than 32-bit ids can count.
Soup read_obj(const MappedFile& file, const ReadOptions& options);

}  // namespace mesher
