#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "engine/core/progress.h"
#include "engine/mesh/mesh.h"

namespace mesher::analysis {

/// Two faces of a mesh, the lower id first.
using FacePair = std::array<Face, 2>;

/// Returns the number of pairs of faces that meet in more than the corners and sides that they
/// share (`do_intersect` in triangle_pair.h defines this). Exact.
///
/// Faces without area are skipped. They are segments, and each of their points is on a side of a
/// neighbor, unless the neighbor has no area either. If that side pierces another face, the
/// neighbor counts. Removed faces, which have no corners, are skipped, too.
///
/// O(F log F) expected for meshes whose faces are near few others, O(F^2) in the worst case;
/// parallel. Needs 100 bytes per face. Throws Cancelled. Pre: positions are finite.
std::uint64_t count_self_intersections(const Mesh& mesh, Progress* progress = nullptr);

/// Returns the pairs that count_self_intersections counts, sorted.
std::vector<FacePair> self_intersections(const Mesh& mesh, Progress* progress = nullptr);

}  // namespace mesher::analysis
