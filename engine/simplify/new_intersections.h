#pragma once

#include "engine/core/progress.h"
#include "engine/simplify/simplify.h"

namespace mesher {

/// Whether two faces of the result intersect that did not in the input (`do_intersect` in
/// engine/analysis/triangle_pair.h says what counts; faces without area in the input do not
/// intersect). The same rule as that of IntersectionGuard, but for the result alone. Exact. O(F log
/// F) expected in the faces of the result, parallel. Throws Cancelled.
bool has_new_intersections(const Mesh& input, const Simplified& result,
                           Progress* progress = nullptr);

}  // namespace mesher
