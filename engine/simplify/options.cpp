#include "engine/simplify/options.h"

namespace mesher {

std::string_view key(CostPolicy policy) {
  switch (policy) {
    case CostPolicy::quadric:
      return "quadric";
    case CostPolicy::accumulated_quadric:
      return "accumulated";
    case CostPolicy::edge_length:
      return "length";
    case CostPolicy::shape:
      return "shape";
    case CostPolicy::random:
      return "random";
  }
  return "";
}

std::string_view key(Placement placement) {
  switch (placement) {
    case Placement::optimal:
      return "optimal";
    case Placement::midpoint:
      return "midpoint";
    case Placement::endpoint:
      return "endpoint";
  }
  return "";
}

}  // namespace mesher
