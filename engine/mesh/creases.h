#pragma once

#include "engine/mesh/mesh.h"

namespace mesher {

/// Marks every edge whose faces meet at more than `angle_rad` as infinitely sharp; leaves the
/// others as they are. Returns how many were marked. O(F).
std::uint32_t tag_creases_by_angle(Mesh& mesh, float angle_rad);

/// Angle between the normals of the two faces at an edge, 0 (flat) to pi (folded); 0 on a boundary.
float dihedral_angle_rad(const Mesh& mesh, Edge e);

}  // namespace mesher
