#pragma once

#include "engine/subdivide/features.h"
#include "engine/subdivide/level.h"
#include "engine/subdivide/options.h"
#include "engine/subdivide/rings.h"

namespace mesher::subdivide {

/// Returns the next level of modified butterfly subdivision; old vertices are copied. No stencil
/// reaches across a boundary or a crease: a missing wing is the reflection of the opposite vertex,
/// and the edge itself uses the four-point rule. A vertex on a boundary or crease counts as
/// regular. Semi-sharp edges blend the smooth and the sharp rule. O(F), parallel. Throws Cancelled.
Level butterfly_step(const LevelView& coarse, const Rings& rings, const Features& features,
                     const SubdivideOptions& options, bool is_last);

/// Returns the next level with edges split in the middle; no vertex moves.
Level midpoint_step(const LevelView& coarse, const SubdivideOptions& options, bool is_last);

}  // namespace mesher::subdivide
