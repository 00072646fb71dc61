#pragma once

#include "engine/simplify/cost_policy.h"
#include "engine/simplify/fan.h"
#include "engine/simplify/surface.h"

namespace mesher {

/// What a legal collapse does to the surface, harm included that its planes do not show.
struct Appraisal {
  float cost = kNever;   ///< area times squared distance, as Candidate::cost
  float retreat = 0.0F;  ///< what the merged vertex's VertexState::retreat will be
};

/// Adds two kinds of harm to the candidate's cost. Both compare with it, since both are an area
/// times a squared distance; so a rule that is broken makes a collapse dearer, not impossible, and
/// what is smaller than the error so far hardly counts.
///
///  - The surface retreats. The planes of a thin part run along it: to them its tip may be cut off
///    for little, and its area is small. So where the faces at an end point in many directions, the
///    distance `d` from both ends to the new faces, and from the new vertex to the old ones, is
///    found, and what the ends have retreated before is added: a part that is eaten in many small
///    bites costs as much as one that is cut off at once. A part that sticks out by `d` is worth as
///    much as an area of `d * d`: the harm is the fourth power of `d`.
///  - Faces turn or fold (Fan::turned_area): the harm is the square of their area.
///
/// O(valence). Pre: `fan` is gathered for `h` and its shape is checked at the candidate's position.
Appraisal appraise(const Surface& surface, Halfedge h, const Fan& fan, const Candidate& candidate);

}  // namespace mesher
