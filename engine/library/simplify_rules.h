#pragma once

#include <mesher/simplify.h>

#include "engine/simplify/options.h"

namespace mesher {

/// Throws UsageError if a weight is below 0 or no number.
void check_weights(const AttributeWeights& weights);

/// Returns the rules that simplification and progressive meshes share, in the engine's types.
/// Throws UsageError for weights that are none.
template <class Options>
simplify::SimplifyOptions engine_rules(const Options& options) {
  static_assert(int(CostPolicy::random) == int(simplify::CostPolicy::random));
  static_assert(int(Placement::endpoint) == int(simplify::Placement::endpoint));
  static_assert(int(BoundaryRule::lock) == int(simplify::BoundaryRule::lock));
  static_assert(AttributeWeights{}.texcoord == simplify::AttributeWeights{}.texcoord);
  static_assert(AttributeWeights{}.normal == simplify::AttributeWeights{}.normal);
  static_assert(AttributeWeights{}.color == simplify::AttributeWeights{}.color);
  static_assert(AttributeWeights{}.joint == simplify::AttributeWeights{}.joint);
  check_weights(options.weights);
  return {.cost = static_cast<simplify::CostPolicy>(options.cost),
          .placement = static_cast<simplify::Placement>(options.placement),
          .boundary = static_cast<simplify::BoundaryRule>(options.boundary),
          .crease_angle_deg = options.crease_angle_deg,
          .weight_uv = options.weights.texcoord,
          .weight_normal = options.weights.normal,
          .weight_color = options.weights.color,
          .weight_joint = options.weights.joint};
}

}  // namespace mesher
