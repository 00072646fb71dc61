#pragma once

#include <mesher/simplify.h>

#include "engine/simplify/options.h"

namespace mesher {

/// Returns the rules that simplification and progressive meshes share, in the engine's types.
template <class Options>
simplify::SimplifyOptions engine_rules(const Options& options) {
  static_assert(int(CostPolicy::random) == int(simplify::CostPolicy::random));
  static_assert(int(Placement::endpoint) == int(simplify::Placement::endpoint));
  static_assert(int(BoundaryRule::lock) == int(simplify::BoundaryRule::lock));
  return {.cost = static_cast<simplify::CostPolicy>(options.cost),
          .placement = static_cast<simplify::Placement>(options.placement),
          .boundary = static_cast<simplify::BoundaryRule>(options.boundary),
          .crease_angle_deg = options.crease_angle_deg};
}

}  // namespace mesher
