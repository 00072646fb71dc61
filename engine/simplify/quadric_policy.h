#pragma once

#include "engine/simplify/cost_policy.h"

namespace mesher::simplify {

/// By how many tie-breaks an end must be cheaper than the optimum to replace it.
inline constexpr float kClearlyCheaper = 10.0F;

/// The default policy: least area-weighted squared distance to the planes of the current faces, at
/// a position that preserves the volume (engine/simplify/quadric.h). Processes eight edges at a
/// time where there are no features.
class QuadricPolicy : public CollapsePolicy {
 public:
  explicit QuadricPolicy(Placement placement) : placement_(placement) {}

  bool costs_are_errors() const override { return true; }
  Candidate evaluate(const Surface& surface, Halfedge h, AllowedPlacement allowed) const override;
  void evaluate_costs(const Surface& surface, std::span<const Halfedge> edges,
                      CostPrecision precision, float* costs) const override;
  void evaluate_around(const Surface& surface, Vertex v, const Fan& fan, CostPrecision precision,
                       float* costs) const override;

 protected:
  Placement placement() const { return placement_; }

 private:
  Placement placement_;
};

}  // namespace mesher::simplify
