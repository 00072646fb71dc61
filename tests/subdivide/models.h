#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "engine/mesh/build/soup.h"
#include "engine/mesh/mesh.h"

namespace mesher::test {

/// A small mesh with its creases.
struct Model {
  std::string name;
  Mesh mesh;
};

/// All models: closed and open, with valences from 3 to 64, with and without creases. Their
/// positions have no symmetry, which could hide errors.
const std::vector<Model>& models();

/// Whether every sharpness is zero or infinite.
bool is_settled(const Mesh& mesh);

/// Whether no interior edge and no vertex is sharp, by a tag or as a bow tie.
bool is_untagged(const Mesh& mesh);

/// Two caps of `valence` triangles each on a common ring.
Soup bipyramid(std::uint32_t valence);

/// `faces` triangles around vertex 0; closed, or with a gap.
Soup fan(std::uint32_t faces, bool is_closed);

Soup icosahedron();
Soup octahedron();

/// Moves every vertex by a random offset of up to `by`.
Soup jittered(Soup soup, float by, std::uint32_t seed = 1);

/// Number of levels, at most `most`, that keeps the face count small enough for a test.
std::uint32_t affordable_levels(const Mesh& mesh, std::uint32_t most);

}  // namespace mesher::test
