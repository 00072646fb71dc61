#pragma once

#include <vector>

#include "engine/analysis/self_intersections.h"
#include "engine/core/progress.h"
#include "engine/simplify/simplify.h"

namespace mesher::simplify {

/// Returns the pairs of faces that intersect in a mesh, but did not before it was simplified
/// (`do_intersect` in engine/analysis/triangle_pair.h defines intersection; faces that were
/// degenerate did not intersect). Both have the same ids, and removed faces have no corners. Exact.
/// Expected O(F log F) in the remaining faces, parallel. Throws Cancelled.
std::vector<analysis::FacePair> new_intersections(const Mesh& before, const Mesh& after,
                                                  Progress* progress = nullptr);

/// Returns whether two faces of the result intersect that did not intersect in the input,
/// in the sense of new_intersections. Exact. Expected O(F log F) in the faces of the result,
/// parallel. Throws Cancelled.
bool has_new_intersections(const Mesh& input, const Simplified& result,
                           Progress* progress = nullptr);

}  // namespace mesher::simplify
