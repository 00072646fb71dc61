#pragma once

#include <cstdint>
#include <string_view>

#include "engine/io/gltf_file.h"
#include "engine/mesh/contents.h"

namespace mesher::io {

/// Refuses a document that requires an extension without which mesher would read a wrong shape.
/// Extensions of materials, textures, lights and metadata do not change it. Throws InputError with
/// the extension's name.
void check_required_extensions(const GltfFile& gltf);

/// Returns whether the shape is right without regard to the extension, or mesher reads it. Such an
/// extension refers to no accessor or buffer view that mesher does not know of.
bool is_shape_known(std::string_view extension);

/// Counts what a document holds, by its JSON alone. Does not judge it. Contents that are read as
/// the shape itself (positions, triangles) are not counted.
void note_contents(const GltfFile& gltf, FileContents& contents);

/// Returns the number of indices, or of vertices, that a primitive claims to have; 0 if it is
/// malformed.
std::uint64_t claimed_elements(const GltfFile& gltf, const GltfFile::Json& primitive);

}  // namespace mesher::io
