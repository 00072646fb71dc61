#pragma once

#include <cstdint>
#include <memory>

#include "engine/simplify/cost_policy.h"

namespace mesher {

// Other policies than the default: classics, policies for special goals, and baselines.

/// Quadrics of the input's planes, weighted by area and summed along all collapses (M. Garland, P.
/// Heckbert, "Surface simplification using quadric error metrics", 1997). In double precision,
/// relative to the first vertex. 104 bytes per vertex.
std::unique_ptr<CollapsePolicy> make_accumulated_policy(Placement placement,
                                                        const Surface& surface);

/// Cost: the squared length of the edge.
std::unique_ptr<CollapsePolicy> make_length_policy(Placement placement);

/// Cost: deviation of the new faces from equilateral. Each face contributes the sum of its squared
/// sides minus 4 sqrt(3) times its area, which is zero for an equilateral triangle (I.
/// Weitzenboeck, 1919). The squared length of the edge is added, so that among equal shapes the
/// smallest goes first.
std::unique_ptr<CollapsePolicy> make_shape_policy(Placement placement);

/// Cost: a pseudorandom number in [0, 1) from the seed and both ends. All orders are equally
/// likely.
std::unique_ptr<CollapsePolicy> make_random_policy(Placement placement, std::uint64_t seed);

}  // namespace mesher
