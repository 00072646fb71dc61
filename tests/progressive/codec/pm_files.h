#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "engine/mesh/mesh.h"
#include "engine/progressive/progressive_attributes.h"
#include "engine/progressive/progressive_mesh.h"

namespace mesher::test {

using Bytes = std::vector<std::byte>;

/// Returns the bytes of the mesh as a file.
Bytes written(progressive::ProgressiveMesh& mesh, unsigned coordinate_bits = 0);
/// Same, with attributes and bytes beside them.
Bytes written(progressive::ProgressiveMesh& mesh, progressive::ProgressiveAttributes& attributes,
              unsigned coordinate_bits = 0, std::span<const std::byte> appendix = {});

/// Result of reading a file: either `error` or a mesh.
struct ReadBack {
  std::string error;
  std::string damage;
  bool is_complete = false;
  progressive::ProgressiveMesh mesh;
  progressive::ProgressiveAttributes attributes;
  Bytes appendix;
};

/// Reads a file, fed in pieces of `piece` bytes (0: all at once).
ReadBack read_back(std::span<const std::byte> bytes, std::size_t piece = 0);

/// Corrects every checksum of a file whose sizes are still plausible.
void mend_checksums(Bytes& bytes);

/// Fails unless the file was rejected, or read into a valid mesh with valid attributes that is
/// either complete or reported as damaged.
void expect_sound(ReadBack& read);

/// Fails unless both have the same attributes at levels evenly spread up to the last one of `b`,
/// bit for bit.
void expect_same_attributes(const progressive::ProgressiveMesh& mesh,
                            progressive::ProgressiveAttributes& a,
                            progressive::ProgressiveAttributes& b);

/// Meshes of every kind: with and without sharpness, with boundaries, isolated vertices and many
/// parts.
struct NamedMesh {
  std::string name;
  Mesh mesh;
};
std::vector<NamedMesh> meshes_of_all_kinds();

}  // namespace mesher::test
