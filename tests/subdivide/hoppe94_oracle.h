#pragma once

#include "tests/subdivide/loop_oracle.h"

namespace mesher::test {

/// Position of the new point of a sharp edge, as a fraction from the first end, by the kinds of its
/// ends. Negative: the edge uses the smooth mask. Source: H. Hoppe et al., "Piecewise smooth
/// surface reconstruction", 1994.
double hoppe94_sharp_edge(Kind a, Kind b);

inline OracleRules hoppe94_rules(subdivide::CreaseDecay decay = subdivide::CreaseDecay::uniform) {
  return {.sharp_edge = hoppe94_sharp_edge, .decay = decay};
}

}  // namespace mesher::test
