#pragma once

#include "tests/subdivide/loop_oracle.h"

namespace mesher::test {

/// H. Hoppe et al., "Piecewise smooth surface reconstruction", 1994: the new point of a sharp edge
/// by the kinds of its ends, as a way from the first; negative: as on a smooth edge.
double hoppe94_sharp_edge(Kind a, Kind b);

inline OracleRules hoppe94_rules(CreaseDecay decay = CreaseDecay::uniform) {
  return {.sharp_edge = hoppe94_sharp_edge, .decay = decay};
}

}  // namespace mesher::test
