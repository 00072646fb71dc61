#pragma once

#include "engine/simplify/cost_policy.h"

namespace mesher {

/// The default: least area-weighted squared distance to the planes of the faces as they are, at a
/// place that keeps the volume (engine/simplify/quadric.h). Where nothing is a feature it takes
/// eight edges at a time.
class QuadricPolicy : public CollapsePolicy {
 public:
  explicit QuadricPolicy(Placement placement) : placement_(placement) {}

  bool costs_are_errors() const override { return true; }
  Candidate evaluate(const Surface& surface, Halfedge h, AllowedPlacement allowed) const override;
  void evaluate_costs(const Surface& surface, std::span<const Halfedge> edges,
                      CostPrecision precision, float* costs) const override;
  void evaluate_around(const Surface& surface, Vertex v, const Fan& fan, CostPrecision precision,
                       float* costs) const override;

 private:
  Placement placement_;
};

}  // namespace mesher
