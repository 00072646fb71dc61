#pragma once

#include <cstdint>
#include <vector>

#include "engine/mesh/mesh.h"
#include "engine/subdivide/options.h"
#include "tests/subdivide/plain_mesh.h"

namespace mesher::test {

/// Allowed difference of a result, relative to the diagonal of the model.
inline constexpr double kTolerance = 1e-6;

inline constexpr subdivide::BoundaryRounding kBoundaries[] = {
    subdivide::BoundaryRounding::edge_only, subdivide::BoundaryRounding::edge_and_corner};
inline constexpr subdivide::CreaseDecay kDecays[] = {subdivide::CreaseDecay::uniform,
                                                     subdivide::CreaseDecay::chaikin};

/// One of every combination of scheme, creases, boundary and decay that gives a different result.
std::vector<subdivide::SubdivideOptions> every_rule(std::uint32_t levels);

std::vector<Triangle> triangles_of(const Mesh& mesh);

/// Fails if `ours` is not a valid mesh, if its triangles differ from `reference`, or if a position
/// differs by more than `tolerance` (model units).
void expect_same(const Mesh& ours, const PlainMesh& reference, double tolerance);

/// Fails if the sharpness of an interior edge or of a vertex differs. Sharpness that follows from a
/// rule, as at boundaries and bow ties, may be missing.
void expect_same_sharpness(const Mesh& ours, const PlainMesh& reference);

bool has_boundary(const Mesh& mesh);

}  // namespace mesher::test
