#pragma once

#include <vector>

#include "engine/mesh/mesh.h"
#include "engine/subdivide/options.h"
#include "tests/subdivide/plain_mesh.h"

namespace mesher::test {

/// How far a result may be off, in diagonals of the model.
inline constexpr double kTolerance = 1e-6;

inline constexpr BoundaryRounding kBoundaries[] = {BoundaryRounding::edge_only,
                                                   BoundaryRounding::edge_and_corner};
inline constexpr CreaseDecay kDecays[] = {CreaseDecay::uniform, CreaseDecay::chaikin};

std::vector<Triangle> triangles_of(const Mesh& mesh);

/// Fails where `ours` is no valid mesh, has other triangles than `reference`, or a position that is
/// off by more than `tolerance` (model units).
void expect_same(const Mesh& ours, const PlainMesh& reference, double tolerance);

/// Fails where an edge inside or a vertex has another sharpness. What is sharp by rule, as the
/// boundary and bow ties are, need not be written down.
void expect_same_sharpness(const Mesh& ours, const PlainMesh& reference);

bool has_boundary(const Mesh& mesh);

}  // namespace mesher::test
