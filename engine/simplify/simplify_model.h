#pragma once

#include "engine/mesh/attributes.h"
#include "engine/mesh/mesh.h"
#include "engine/simplify/seams.h"
#include "engine/simplify/simplify.h"

namespace mesher::simplify {

/// A simplified mesh with its attributes.
struct SimplifiedModel {
  Simplified simplified;
  Attributes attributes;
  /// Seams were crossed, because that cost less or no other collapse was left.
  bool crosses_seams = false;
};

/// Simplifies a mesh with its attributes: along seams as `mark_seams` describes, or across them
/// where that costs less (SimplifyOptions::crosses_seams), if there is a target number of faces. A
/// target that is still out of reach is simplified without seams and without a metric. `prunes` as
/// in simplify_pruned; the preconditions are those of `simplify` and simplify_pruned. Without
/// attributes this is `simplify`. The last resort takes twice the time. Keeps one copy of a mesh
/// with attributes. Throws Cancelled.
[[nodiscard]] SimplifiedModel simplify_model(Mesh&& mesh, const Attributes& attributes,
                                             const SimplifyOptions& options, bool prunes = false);

}  // namespace mesher::simplify
