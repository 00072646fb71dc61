#pragma once

#include <cstdint>
#include <filesystem>

#include "engine/mesh/build/soup.h"
#include "engine/mesh/mesh.h"

namespace mesher::bench {

/// Closed, wavy torus of 2 * n * n triangles and n * n vertices, in grid order. It is the same on
/// every machine up to the last bit of sin and cos.
Soup torus(std::uint32_t n);

/// Closed surface of 2 * n * n triangles and n * n vertices, in grid order: a torus with eight
/// octaves of noise, rough like a scanned stone.
Soup bumpy_torus(std::uint32_t n);

/// Returns the triangles of a mesh as arrays.
Soup triangles_of(const Mesh& mesh);

/// Returns a surface with its faces and vertices in random order (fixed seed). This is the worst
/// case for caches, like exports of unordered triangles.
Soup shuffled(const Soup& soup);

enum class ObjContent { positions, positions_texcoords_normals };

/// Writes a torus as OBJ text of about `bytes` bytes, with six decimals per number, as exporters
/// do. Does nothing if the file already exists.
void write_obj(const std::filesystem::path& file, std::uint64_t bytes, ObjContent content);

}  // namespace mesher::bench
