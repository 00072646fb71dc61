#include "engine/subdivide/options.h"

namespace mesher {

std::string_view key(Scheme scheme) {
  switch (scheme) {
    case Scheme::loop:
      return "loop";
    case Scheme::butterfly:
      return "butterfly";
    case Scheme::midpoint:
      return "midpoint";
  }
  return "";
}

std::string_view key(CreaseRules rules) {
  switch (rules) {
    case CreaseRules::hoppe94:
      return "hoppe94";
    case CreaseRules::derose98:
      return "derose98";
  }
  return "";
}

std::string_view key(BoundaryRounding boundary) {
  switch (boundary) {
    case BoundaryRounding::edge_only:
      return "edge-only";
    case BoundaryRounding::edge_and_corner:
      return "edge-and-corner";
  }
  return "";
}

std::string_view key(CreaseDecay decay) {
  switch (decay) {
    case CreaseDecay::uniform:
      return "uniform";
    case CreaseDecay::chaikin:
      return "chaikin";
  }
  return "";
}

}  // namespace mesher
