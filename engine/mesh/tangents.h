#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <span>

#include "engine/core/array.h"
#include "engine/mesh/mesh.h"

namespace mesher {

/// Returns one tangent per corner, as MikkTSpace defines them (M. Mikkelsen, "Simulation of
/// Wrinkled Surfaces Revisited", 2008). xyz is the direction in which u grows, of unit length and
/// perpendicular to the normal. w is 1 or -1: cross(normal, xyz) times w is the direction in which
/// v grows.
///
/// Corners of a vertex share a tangent if they have the same normal and the same texture
/// coordinates, their faces are connected by edges that have the same at both ends, and the texture
/// is mirrored on all of their faces or on none. Each face counts with its angle at the vertex.
/// Faces whose texture coordinates have no area get the tangent of their neighbors. A corner
/// without a tangent gets zero.
///
/// `normals`, `texcoords`: one per corner; normals have unit length, and v grows upward in the
/// image. O(F), parallel.
Array<glm::vec4> corner_tangents(const Mesh& mesh, std::span<const glm::vec3> normals,
                                 std::span<const glm::vec2> texcoords);

}  // namespace mesher
