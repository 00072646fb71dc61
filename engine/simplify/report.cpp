#include "engine/simplify/report.h"

namespace mesher {

std::string_view key(StopReason reason) {
  switch (reason) {
    case StopReason::target_reached:
      return "target_reached";
    case StopReason::already_there:
      return "already_there";
    case StopReason::no_legal_collapse:
      return "no_legal_collapse";
    case StopReason::error_bound:
      return "error_bound";
    case StopReason::far_from_input:
      return "far_from_input";
  }
  return "";
}

std::string_view describe(StopReason reason) {
  switch (reason) {
    case StopReason::target_reached:
      return "target reached";
    case StopReason::already_there:
      return "had no more faces than asked for";
    case StopReason::no_legal_collapse:
      return "no legal collapse is left";
    case StopReason::error_bound:
      return "every collapse left would exceed the error bound";
    case StopReason::far_from_input:
      return "fewer faces would be too far from the input";
  }
  return "";
}

std::string_view key(Rejection rejection) {
  switch (rejection) {
    case Rejection::link_condition:
      return "link_condition";
    case Rejection::boundary:
      return "boundary";
    case Rejection::crease:
      return "crease";
    case Rejection::fold_over:
      return "fold_over";
    case Rejection::error_bound:
      return "error_bound";
    case Rejection::intersection:
      return "intersection";
  }
  return "";
}

std::string_view describe(Rejection rejection) {
  switch (rejection) {
    case Rejection::link_condition:
      return "link condition";
    case Rejection::boundary:
      return "boundary";
    case Rejection::crease:
      return "crease";
    case Rejection::fold_over:
      return "fold-over";
    case Rejection::error_bound:
      return "error bound";
    case Rejection::intersection:
      return "self-intersection";
  }
  return "";
}

}  // namespace mesher
