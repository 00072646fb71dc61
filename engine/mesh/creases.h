#pragma once

#include <numbers>
#include <vector>

#include "engine/mesh/mesh.h"

namespace mesher {

/// An edge and the sharpness that it shall have.
struct EdgeSharpness {
  Edge edge;
  float sharpness = 0.0F;
};

/// Marks every edge whose faces meet at more than `angle_rad` as infinitely sharp; leaves the
/// others as they are. Returns how many were marked. O(F).
std::uint32_t tag_creases_by_angle(Mesh& mesh, float angle_rad);

/// The edges that tag_creases_by_angle would change: faces meet at more than `angle_rad`, and not
/// infinitely sharp yet. Ascending. O(F), parallel.
std::vector<Edge> untagged_edges_beyond(const Mesh& mesh, float angle_rad);

/// Every edge that is not smooth, boundary edges too. Ascending. O(F), parallel.
std::vector<Edge> sharp_edges(const Mesh& mesh);

/// Angle between the normals of the two faces at an edge, 0 (flat) to pi (folded); 0 on a boundary.
float dihedral_angle_rad(const Mesh& mesh, Edge e);

/// By how much a chain of smooth edges may turn at a vertex: 40 degrees.
inline constexpr float kChainTurnRad = 40.0F * std::numbers::pi_v<float> / 180.0F;

/// The edges that continue `start` both ways, as a person means it who points at a line: in order
/// from one end to the other, `start` among them.
///
/// A sharp edge is continued where exactly one other sharp edge meets it, whatever the turn: a
/// crease has no choice there; three and more are a junction. A smooth edge is continued by the
/// smooth edge that goes on straightest, within `turn_rad`, where that one is continued by it, too.
/// So every edge of a chain has the same chain. A chain ends at the boundary, or where it has come
/// back to `start`; a boundary edge is a chain of its own. O(length x valence).
std::vector<Edge> crease_chain(const Mesh& mesh, Edge start, float turn_rad = kChainTurnRad);

}  // namespace mesher
