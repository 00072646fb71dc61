#pragma once

#include "engine/core/progress.h"
#include "engine/subdivide/level.h"
#include "engine/subdivide/rings.h"

namespace mesher::subdivide {

/// Returns the next level of Loop subdivision as if nothing were sharp; positions on boundaries are
/// arbitrary. `is_last`: without twins and outgoing half-edges. O(F). Throws Cancelled. Pre:
/// `rings` are those of `coarse`.
///
/// If `rings` list no spokes, one thread scatters: a single sweep over the faces adds each face's
/// contributions to its vertices and edges. Otherwise threads gather: each vertex and edge sums
/// over its faces in the same order, so that the bytes are the same.
Level smooth_step(const LevelView& coarse, const Rings& rings, bool is_last, Progress* progress);

}  // namespace mesher::subdivide
