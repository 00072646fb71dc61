#pragma once

#include "engine/core/array.h"
#include "engine/simplify/reorder.h"
#include "engine/simplify/surface.h"

namespace mesher::simplify {

/// Input and result of a run, and which parts of one are near parts of the other: the input of
/// distance measurement. Both meshes are in the order of the run, so neighbors in space are
/// neighbors in memory.
struct Trace {
  Mesh before;
  Mesh after;
  Array<Vertex> vertex_before;  ///< for each vertex after the run, its id before
  Array<Face> near_before;  ///< for each face before the run, one after it that is probably near
  Array<Face> near_after;   ///< for each face after the run, one before it that is probably near
};

/// Returns, for each vertex, the one into which it was merged in the end; itself if it is still
/// there. O(V).
Array<std::uint32_t> find_survivors(const Surface& surface);

/// Fills in the members for the state after the run. Pre: `before` is set and has the surface's
/// ids. O(F).
void trace(const Surface& surface, Trace& trace);

}  // namespace mesher::simplify
