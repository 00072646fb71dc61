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

/// The bytes of its file.
Bytes written(ProgressiveMesh& mesh, unsigned coordinate_bits = 0);

/// What became of a file: either `error`, or a mesh.
struct ReadBack {
  std::string error;
  std::string damage;
  bool is_complete = false;
  ProgressiveMesh mesh;
};

/// Reads it, fed in pieces of so many bytes; 0: whole.
ReadBack read_back(std::span<const std::byte> bytes, std::size_t piece = 0);

/// Puts right every checksum of a file whose sizes still make sense.
void mend_checksums(Bytes& bytes);

/// Fails where a file was neither refused nor read into a valid mesh that is either complete or
/// said to be damaged.
void expect_sound(ReadBack& read);

/// Meshes of every kind, with and without sharpness, with boundaries, isolated vertices, many
/// parts.
struct NamedMesh {
  std::string name;
  Mesh mesh;
};
std::vector<NamedMesh> meshes_of_all_kinds();

}  // namespace mesher::test
