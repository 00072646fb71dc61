#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "engine/mesh/mesh.h"
#include "engine/progressive/progressive_mesh.h"

namespace mesher::test {

using Bytes = std::vector<std::byte>;

/// Returns the bytes of the mesh as a file.
Bytes written(progressive::ProgressiveMesh& mesh, unsigned coordinate_bits = 0);

/// Result of reading a file: either `error` or a mesh.
struct ReadBack {
  std::string error;
  std::string damage;
  bool is_complete = false;
  progressive::ProgressiveMesh mesh;
};

/// Reads a file, fed in pieces of `piece` bytes (0: all at once).
ReadBack read_back(std::span<const std::byte> bytes, std::size_t piece = 0);

/// Corrects every checksum of a file whose sizes are still plausible.
void mend_checksums(Bytes& bytes);

/// Fails unless the file was rejected, or read into a valid mesh that is either complete or
/// reported as damaged.
void expect_sound(ReadBack& read);

/// Meshes of every kind: with and without sharpness, with boundaries, isolated vertices and many
/// parts.
struct NamedMesh {
  std::string name;
  Mesh mesh;
};
std::vector<NamedMesh> meshes_of_all_kinds();

}  // namespace mesher::test
