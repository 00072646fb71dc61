#pragma once

#include "engine/subdivide/features.h"
#include "engine/subdivide/level.h"
#include "engine/subdivide/options.h"
#include "engine/subdivide/rings.h"

namespace mesher::subdivide {

/// Returns the next level of Loop subdivision with creases: everything by the smooth masks first,
/// then the edges and vertices in `features` by the crease rules. `is_last`: without twins and
/// outgoing half-edges. O(F). Throws Cancelled.
Level loop_step(const LevelView& coarse, const Rings& rings, const Features& features,
                const SubdivideOptions& options, bool is_last);

}  // namespace mesher::subdivide
