#pragma once

#include "engine/simplify/cost_policy.h"
#include "engine/simplify/fan.h"
#include "engine/simplify/surface.h"

namespace mesher::simplify {

/// Cost of a legal collapse, including damage that the plane quadrics do not see.
struct Appraisal {
  float cost = kNever;   ///< area times squared distance, as Candidate::cost
  float retreat = 0.0F;  ///< the VertexState::retreat of the merged vertex
  /// The part of the cost that estimates how far points of the input are left behind: all but the
  /// penalty of turned faces. Points that are measured replace it.
  float left_behind = kNever;
};

/// Returns the candidate's cost plus penalties for two kinds of damage. Both penalties are an area
/// times a squared distance, so they are commensurable with the cost: breaking a rule makes a
/// collapse more expensive, not impossible, and damage smaller than the error so far hardly counts.
///
///  - Retreat of the surface. The planes of a thin part run along it, so cutting off its tip costs
///    them little, and the tip's area is small. Where the faces at an end point in many directions,
///    `d` is the largest of the distances from either end to the new faces and from the new vertex
///    to the old faces. The earlier retreat of the ends is added to `d`, so removing a part in many
///    small steps costs as much as removing it at once. A part that sticks out by `d` counts as an
///    area of `d * d`, so the penalty is `d` to the fourth power.
///  - Faces that turn or fold (Fan::turned_area). The penalty is the square of their compact area.
///
/// Pre: `fan` is gathered for `h` and its shape is checked at the candidate's position. O(valence).
Appraisal appraise(const Surface& surface, Halfedge h, const Fan& fan, const Candidate& candidate);

}  // namespace mesher::simplify
