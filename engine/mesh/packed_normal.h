#pragma once

#include <cstdint>
#include <glm/vec3.hpp>

namespace mesher {

/// Returns a unit vector packed as two signed 16-bit numbers, x in the low half: an octahedron
/// unfolded to a square (Q. Meyer et al., "On floating-point normal vectors", 2010). The error is
/// below 0.002 degrees. The zero vector becomes +z.
std::uint32_t encode_normal(const glm::vec3& normal);
/// Returns the unit vector, computed as in the shaders.
glm::vec3 decode_normal(std::uint32_t packed);

}  // namespace mesher
