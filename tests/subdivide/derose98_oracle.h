#pragma once

#include "tests/subdivide/loop_oracle.h"

namespace mesher::test {

/// Weights of a sharp edge by T. DeRose, M. Kass, T. Truong, "Subdivision surfaces in character
/// animation", 1998: the midpoint, for any kinds of ends.
inline double derose98_sharp_edge(Kind, Kind) {
  return 0.5;
}

inline OracleRules derose98_rules(subdivide::CreaseDecay decay = subdivide::CreaseDecay::uniform) {
  return {.sharp_edge = derose98_sharp_edge, .decay = decay};
}

}  // namespace mesher::test
