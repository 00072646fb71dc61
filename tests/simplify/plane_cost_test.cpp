#include "engine/simplify/plane_cost.h"

#include <gtest/gtest.h>

#include <cmath>

#include "engine/mesh/build/build.h"
#include "tests/support/meshes.h"

namespace mesher::test {
namespace {

/// The sum over both stars, computed from its definition.
double cost_by_definition(const simplify::Surface& surface, Halfedge edge, const glm::vec3& p) {
  const Mesh& mesh = surface.mesh();
  double sum = 0.0;
  for (const Vertex end : {mesh.origin(edge), mesh.target(edge)}) {
    for (std::uint32_t i = 0; i < mesh.halfedge_count(); ++i) {
      const Halfedge h(i);
      if (mesh.origin(h) != end) continue;
      const simplify::FaceShape& face = surface.shape(Mesh::face(h));
      const glm::vec3 moved = p - mesh.position(end);
      const double distance = double{face.normal.x} * double{moved.x} +
                              double{face.normal.y} * double{moved.y} +
                              double{face.normal.z} * double{moved.z};
      sum += double{face.area} * distance * distance;
      for (const Halfedge side : {h, Mesh::prev(h)}) {
        if (!surface.is_feature(side)) continue;
        const glm::vec3 across = surface.across(side);
        const double off = double{across.x} * double{moved.x} + double{across.y} * double{moved.y} +
                           double{across.z} * double{moved.z};
        sum += off * off;
      }
    }
  }
  return sum;
}

void expect_definition(const simplify::Surface& surface) {
  const Mesh& mesh = surface.mesh();
  for (std::uint32_t i = 0; i < mesh.halfedge_count(); ++i) {
    const Halfedge h(i);
    const glm::vec3 from = mesh.position(mesh.origin(h));
    const glm::vec3 to = mesh.position(mesh.target(h));
    const glm::vec3 p = 0.3F * from + 0.7F * to + glm::vec3(0.1F, -0.2F, 0.3F);
    const auto costs = simplify::plane_costs(surface, h, p);
    ASSERT_TRUE(costs);
    EXPECT_NEAR(costs->at_point, cost_by_definition(surface, h, p), 1e-4);
    EXPECT_NEAR(costs->at_origin, cost_by_definition(surface, h, from), 1e-4);
    EXPECT_NEAR(costs->at_target, cost_by_definition(surface, h, to), 1e-4);
  }
}

TEST(PlaneCosts, SumThePlanesOfBothStars) {
  expect_definition(simplify::Surface(build_mesh(torus(6, 5)).mesh, {}));
}

TEST(PlaneCosts, SumThePlanesAcrossFeatures) {
  expect_definition(simplify::Surface(build_mesh(grid(4)).mesh, {}));
}

TEST(PlaneCosts, AreNotComputedAtAHub) {
  Soup hub;
  constexpr std::uint32_t kSpokes = 80;
  hub.positions.emplace_back(0.0F);
  for (std::uint32_t i = 0; i < kSpokes; ++i) {
    const float angle = 6.2831853F * static_cast<float>(i) / static_cast<float>(kSpokes);
    hub.positions.emplace_back(std::cos(angle), std::sin(angle), 0.0F);
    for (const std::uint32_t v : {0U, i + 1, (i + 1) % kSpokes + 1})
      hub.corners.push_back(v);
  }
  const simplify::Surface surface(build_mesh(std::move(hub)).mesh, {});
  EXPECT_FALSE(simplify::plane_costs(surface, Halfedge(0), glm::vec3(0.0F)));
}

}  // namespace
}  // namespace mesher::test
