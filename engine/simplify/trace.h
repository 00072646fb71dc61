#pragma once

#include "engine/core/array.h"
#include "engine/simplify/reorder.h"
#include "engine/simplify/surface.h"

namespace mesher {

/// A mesh before and after a run, in the order of the run, in which what is near in space is near
/// in memory, and which parts of one are where parts of the other were: what measuring the distance
/// of the two starts from.
struct Trace {
  Mesh before;
  Mesh after;
  Array<Vertex> vertex_before;  ///< for each vertex after the run its id before
  Array<Face> near_before;  ///< for each face before the run one after it that is likely to be near
  Array<Face> near_after;   ///< the other way round
};

/// Fills in what is after the run; `before` is there, with the ids of the surface. O(F).
void trace(const Surface& surface, Trace& trace);

}  // namespace mesher
