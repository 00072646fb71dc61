#pragma once

#include <cstdint>
#include <memory>

#include "engine/simplify/cost_policy.h"

namespace mesher {

// Policies beside the default: classics, special goals, and baselines to compare it with.

/// Quadrics of the input's planes, by area, summed along all collapses (M. Garland, P. Heckbert,
/// "Surface simplification using quadric error metrics", 1997). In double, from the first vertex as
/// origin. 80 bytes a vertex.
std::unique_ptr<CollapsePolicy> make_accumulated_policy(Placement placement,
                                                        const Surface& surface);

/// The square of the edge's length.
std::unique_ptr<CollapsePolicy> make_length_policy(Placement placement);

/// How far the faces that a collapse leaves are from equilateral: for each the sum of its squared
/// sides less 4 sqrt(3) times its area (zero where equilateral, I. Weitzenboeck, 1919), and the
/// squared length of the edge, so that of equal shapes the smallest goes first.
std::unique_ptr<CollapsePolicy> make_shape_policy(Placement placement);

/// A number from 0 to 1 by seed and ends: any order is as likely as any other.
std::unique_ptr<CollapsePolicy> make_random_policy(Placement placement, std::uint64_t seed);

}  // namespace mesher
