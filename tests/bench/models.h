#pragma once

#include <cstdint>
#include <filesystem>

#include "engine/mesh/mesh.h"
#include "engine/mesh/soup.h"

namespace mesher::bench {

/// Closed, wavy torus of 2 * n * n triangles and n * n vertices, in the order of its grid. The same
/// on every machine up to the last bit of sin and cos.
Soup torus(std::uint32_t n);

/// Closed surface of 2 * n * n triangles and n * n vertices, in the order of its grid: a torus with
/// eight octaves of noise on it, rough like a scanned stone.
Soup bumpy_torus(std::uint32_t n);

/// The triangles of a mesh, as arrays.
Soup triangles_of(const Mesh& mesh);

/// A surface with its faces and vertices in a random order (fixed seed): the worst case for
/// caches, as exports of unordered triangles are.
Soup shuffled(const Soup& soup);

enum class ObjContent { positions, positions_texcoords_normals };

/// Writes a torus as OBJ text of about `bytes` bytes, six decimals a number, as exporters do.
/// Nothing is done where a file of that name exists.
void write_obj(const std::filesystem::path& file, std::uint64_t bytes, ObjContent content);

}  // namespace mesher::bench
