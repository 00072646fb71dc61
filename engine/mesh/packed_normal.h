#pragma once

#include <cstdint>
#include <glm/vec3.hpp>

namespace mesher {

/// A unit vector as two signed 16-bit numbers, x in the low half: an octahedron unfolded to a
/// square (Q. Meyer et al., "On floating-point normal vectors", 2010). Off by less than 0.002
/// degrees. The zero vector becomes +z.
std::uint32_t encode_normal(const glm::vec3& normal);
/// The unit vector; as shaders do it.
glm::vec3 decode_normal(std::uint32_t packed);

}  // namespace mesher
