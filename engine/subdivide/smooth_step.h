#pragma once

#include "engine/core/progress.h"
#include "engine/subdivide/level.h"
#include "engine/subdivide/rings.h"

namespace mesher {

/// One step of Loop subdivision as if nothing were sharp; what lies on a boundary gets some place.
/// With one thread it is a single sweep over the faces, each of which gives its share to its
/// vertices and edges; with more, vertices and edges gather what they need across their faces, in
/// the same order, so that the bytes are the same. It gathers where `rings` list spokes. `is_last`:
/// without twins and outgoing half-edges. O(F). Throws Cancelled. Pre: `rings` are those of
/// `coarse`.
Level smooth_step(const LevelView& coarse, const Rings& rings, bool is_last, Progress* progress);

}  // namespace mesher
