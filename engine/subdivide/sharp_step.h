#pragma once

#include "engine/subdivide/features.h"
#include "engine/subdivide/level.h"
#include "engine/subdivide/options.h"

namespace mesher::subdivide {

/// Repositions the edge vertices and vertices on creases and boundaries by the crease rules of
/// `options`. O(sharp edges), parallel. Pre: `finer` was made from `coarse`, whose features are
/// `features`, and its positions are those of the smooth masks (on boundaries: arbitrary).
void place_sharp(const LevelView& coarse, const Features& features, const SubdivideOptions& options,
                 Level& finer);

}  // namespace mesher::subdivide
