#pragma once

#include <cstdint>

#include "engine/core/array.h"
#include "engine/io/gltf_file.h"

namespace mesher::io {

/// How the indices of a primitive form triangles.
enum class GltfMode : std::uint64_t { triangles = 4, strip = 5, fan = 6 };

/// Returns the mode of a primitive, or nothing if it has no triangles (points and lines).
std::optional<GltfMode> triangle_mode(const GltfFile& gltf, const GltfFile::Json& primitive);

/// Returns three vertex indices per triangle of a primitive with `vertices` vertices, in the order
/// of the file. Throws InputError if an index is not below `vertices`.
Array<std::uint32_t> triangle_indices(GltfFile& gltf, const GltfFile::Json& primitive,
                                      GltfMode mode, std::size_t vertices);

}  // namespace mesher::io
