#pragma once

#include <optional>
#include <vector>

#include "engine/analysis/hausdorff.h"
#include "engine/analysis/triangle_tree.h"
#include "engine/core/array.h"
#include "engine/simplify/trace.h"

namespace mesher::simplify {

/// The result of a run whose distance from the input was decided.
struct Decided {
  Mesh after;                        ///< Trace::after
  Array<Face> ids;                   ///< Trace::near_after: a face keeps it from run to run
  analysis::HausdorffBounds bounds;  ///< with all faces that are too far away
};

/// Faces of the input, and of the result, whose distances must be decided. Ascending.
struct Recheck {
  std::vector<Face> before;
  std::vector<Face> after;
};

/// Returns the faces whose distances a repeated run may have changed, and those that were too far
/// away before it. All others are still within `distance` of the other surface: a face of the input
/// that is farther than that from every face that vanished has lost nothing that it was near to.
/// Returns nothing if so many faces changed that deciding all is faster. `before`: a tree of the
/// input. O(F) plus the faces near the change.
std::optional<Recheck> faces_to_recheck(const Trace& now, const Decided& earlier, double distance,
                                        analysis::LazyTree& before);

}  // namespace mesher::simplify
