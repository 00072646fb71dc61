#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "engine/mesh/mesh.h"
#include "engine/mesh/soup.h"

namespace mesher::test {

/// A small mesh with its creases.
struct Model {
  std::string name;
  Mesh mesh;
};

/// Every one: closed and open, with valences from 3 to 64, with and without creases. No symmetry is
/// left in their positions, which would hide mistakes.
const std::vector<Model>& models();

/// Whether every sharpness is 0 or for ever.
bool is_settled(const Mesh& mesh);

/// Whether no edge inside and no vertex is sharp, be it by a tag or as a bow tie.
bool is_untagged(const Mesh& mesh);

/// Two caps of `valence` triangles over one ring.
Soup bipyramid(std::uint32_t valence);

/// `faces` triangles around vertex 0; closed, or with a gap.
Soup fan(std::uint32_t faces, bool is_closed);

Soup icosahedron();
Soup octahedron();

/// Moves every vertex by up to `by`, at random.
Soup jittered(Soup soup, float by, std::uint32_t seed = 1);

/// Levels up to `most` that stay below a number of faces that tests have time for.
std::uint32_t affordable_levels(const Mesh& mesh, std::uint32_t most);

}  // namespace mesher::test
