#pragma once

#include "engine/core/progress.h"
#include "engine/simplify/simplify.h"

namespace mesher::simplify {

/// Returns whether two faces of the result intersect that did not intersect in the input
/// (`do_intersect` in engine/analysis/triangle_pair.h defines intersection; degenerate faces of the
/// input do not intersect). IntersectionGuard applies the same rule at every collapse; this checks
/// the result only. Exact. Expected O(F log F) in the faces of the result, parallel. Throws
/// Cancelled.
bool has_new_intersections(const Mesh& input, const Simplified& result,
                           Progress* progress = nullptr);

}  // namespace mesher::simplify
