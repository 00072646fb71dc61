#pragma once

#include "engine/subdivide/features.h"
#include "engine/subdivide/level.h"
#include "engine/subdivide/options.h"
#include "engine/subdivide/rings.h"

namespace mesher {

/// One step of modified butterfly subdivision: old vertices stay. No stencil reaches across a
/// boundary or a crease: a missing wing is the reflection of the vertex opposite, and along the
/// edge itself the four-point rule holds. A vertex on either counts as regular. Semi-sharp edges
/// blend. Old vertices are copied. O(F), parallel. Throws Cancelled.
Level butterfly_step(const LevelView& coarse, const Rings& rings, const Features& features,
                     const SubdivideOptions& options, bool is_last);

/// Splits edges in the middle; nothing moves.
Level midpoint_step(const LevelView& coarse, const SubdivideOptions& options, bool is_last);

}  // namespace mesher
