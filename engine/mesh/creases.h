#pragma once

#include <numbers>
#include <vector>

#include "engine/mesh/mesh.h"

namespace mesher {

/// An edge and its new sharpness.
struct EdgeSharpness {
  Edge edge;
  float sharpness = 0.0F;
};

/// Marks every edge whose face normals differ by more than `angle_rad` as infinitely sharp and
/// leaves the others unchanged. Returns the number of marked edges. O(F).
std::uint32_t tag_creases_by_angle(Mesh& mesh, float angle_rad);

/// Returns the edges that tag_creases_by_angle would change: face normals differ by more than
/// `angle_rad`, and not yet infinitely sharp. Ascending. O(F), parallel.
std::vector<Edge> untagged_edges_beyond(const Mesh& mesh, float angle_rad);

/// Returns every edge with sharpness > 0, including boundary edges. Ascending. O(F), parallel.
std::vector<Edge> sharp_edges(const Mesh& mesh);

/// Returns the angle between the normals of the two faces at an edge, from 0 (flat) to pi (folded);
/// 0 on a boundary.
float dihedral_angle_rad(const Mesh& mesh, Edge e);

/// The largest angle by which a chain of smooth edges may turn at a vertex: 40 degrees.
inline constexpr float kChainTurnRad = 40.0F * std::numbers::pi_v<float> / 180.0F;

/// Returns the edge chain through `start`, as a user expects it when selecting an edge line: in
/// order from one end to the other, including `start`.
///
/// At a vertex, a sharp edge continues into the other sharp edge if there is exactly one, whatever
/// the angle; a vertex with three or more sharp edges is a junction. A smooth edge continues into
/// the smooth edge with the smallest turn below `turn_rad`, if that edge also continues into it.
/// Therefore every edge of a chain has the same chain. A chain ends at the boundary, or when it
/// returns to `start`. A boundary edge is a chain of its own. O(length x valence).
std::vector<Edge> crease_chain(const Mesh& mesh, Edge start, float turn_rad = kChainTurnRad);

}  // namespace mesher
