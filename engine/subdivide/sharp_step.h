#pragma once

#include "engine/subdivide/features.h"
#include "engine/subdivide/level.h"
#include "engine/subdivide/options.h"

namespace mesher {

/// Places anew what lies on creases and boundaries, by the crease rules of `options`.
/// Pre: `finer` was made of `coarse`, whose features are `features`, and everything in it is where
/// the smooth masks have it (on boundaries: anywhere). O(sharp edges), parallel.
void place_sharp(const LevelView& coarse, const Features& features, const SubdivideOptions& options,
                 Level& finer);

}  // namespace mesher
