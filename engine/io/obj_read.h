#pragma once

#include "engine/io/mapped_file.h"
#include "engine/io/read.h"
#include "engine/mesh/build/soup.h"

namespace mesher::io {

/// Reads Wavefront OBJ.
///
/// The text is cut at line ends into chunks of a fixed size, which are parsed in parallel. The
/// result does not depend on the number of threads.
///
/// Supported:
///   - `v` (with weight or color), `vt`, `vn`, and `f` in every index form, with negative indices
///     and forward references;
///   - `g`, `o` and `usemtl`, which together name the group of a face ("object/group/material");
///   - creases as `e a b [s]`, `t crease` and `t corner`;
///   - comments anywhere, and continuation lines;
///   - any line end except a lone carriage return, which counts as white space.
/// Everything else (points, lines, curves, materials) is only counted. A bad index of a texture
/// coordinate or normal costs that corner its attribute; the report counts them. Coordinates far
/// from zero are read again in double precision, about an origin (`choose_origin`). Faces with
/// fewer than three corners and coordinates that are not finite are kept; `build_mesh` drops and
/// counts them. If only some vertices have a color, the others are white.
///
/// O(bytes). Memory: the soup and a few megabytes. Throws InputError with the line for a malformed
/// number, a vertex index that is zero or out of range, or a crease between vertices that do not
/// exist. Throws it without a line if the file has no vertices or more elements than 32-bit indices
/// can address.
Soup read_obj(const MappedFile& file, const ReadOptions& options);

}  // namespace mesher::io
