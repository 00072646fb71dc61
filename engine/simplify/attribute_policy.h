#pragma once

#include "engine/simplify/attribute_field.h"
#include "engine/simplify/quadric_policy.h"

namespace mesher::simplify {

/// The default policy for a mesh with attributes: the cost of the surface (QuadricPolicy) plus that
/// of the attributes (AttributeField), at the position where the sum is least and the volume is
/// preserved. Candidate::error remains that of the surface alone.
class AttributePolicy : public QuadricPolicy {
 public:
  AttributePolicy(Placement placement, const Surface& surface, const AttributeMetric& metric)
      : QuadricPolicy(placement), field_(surface, metric) {}

  Candidate evaluate(const Surface& surface, Halfedge h, AllowedPlacement allowed) const override;
  void evaluate_costs(const Surface& surface, std::span<const Halfedge> edges,
                      CostPrecision precision, float* costs) const override;
  void evaluate_around(const Surface& surface, Vertex v, const Fan& fan, CostPrecision precision,
                       float* costs) const override;
  bool allows(const Surface& surface, Halfedge h, const Fan& fan,
              const glm::vec3& p) const override {
    return !field_.flips_texture(surface, h, fan, p);
  }
  void collapsing(const Surface& surface, Halfedge h, const Fan& fan, const glm::vec3& p) override {
    field_.collapsing(surface, h, fan, p);
  }
  void will_need_later(Halfedge h) const override { field_.will_need_later(h); }
  void will_need(const Mesh& mesh, Halfedge h) const override { field_.will_need(mesh, h); }
  void will_need(const Fan& fan) const override { field_.will_need(fan); }
  AttributeField* attributes() override { return &field_; }

 private:
  Float8 costs(const EdgeQuadric<Float8>& edges, const std::array<Halfedge, 8>& halfedges) const;
  Float8 guessed_costs(const StateLanes<Float8>& from, const StateLanes<Float8>& to,
                       const std::array<Halfedge, 8>& halfedges) const;

  AttributeField field_;
};

}  // namespace mesher::simplify
