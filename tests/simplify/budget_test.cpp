#include "engine/simplify/budget.h"

#include <gtest/gtest.h>

#include <cmath>

#include "engine/simplify/handy_scale.h"
#include "engine/simplify/simplify.h"
#include "tests/support/meshes.h"

namespace mesher::test {
namespace {

using simplify::BudgetItem;
using simplify::CostCurve;
using simplify::CostStep;

BudgetItem item_of(const Mesh& mesh, std::uint64_t weight = 1, double scale = 1.0) {
  CostCurve curve = simplify::cost_curve(mesh, {});
  simplify::scale_costs(curve, simplify::CostPolicy::quadric, scale);
  return {mesh.face_count(), weight, std::move(curve)};
}

double error_at(const Mesh& mesh, std::uint32_t faces) {
  return simplify::simplify(Mesh(mesh), {.target_faces = faces}).report.estimated_error;
}

TEST(CostCurve, CostsRiseAndReachTheFewestFaces) {
  const Mesh mesh = built(torus(60, 40)).mesh;
  const CostCurve curve = simplify::cost_curve(mesh, {.target_faces = 1'000, .max_error = 0.0});
  ASSERT_FALSE(curve.empty());
  for (std::size_t i = 1; i < curve.size(); ++i)
    EXPECT_LE(curve[i - 1].cost, curve[i].cost);
  for (const CostStep& step : curve)
    EXPECT_EQ(step.faces, 2 * step.removals) << "the torus has no boundary";
  const simplify::Simplified fewest = simplify::simplify(Mesh(mesh), {});
  EXPECT_EQ(mesh.face_count() - simplify::removable_faces(curve), fewest.mesh.face_count());
}

TEST(CostCurve, LengthsChangeCostsByTheirFourthPower) {
  const Mesh mesh = built(torus(30, 20)).mesh;
  for (const float size : {0x1p-30F, 0x1p-4F, 0x1p25F}) {
    CostCurve curve = simplify::cost_curve(built(scaled(torus(30, 20), size)).mesh, {});
    simplify::scale_costs(curve, simplify::CostPolicy::quadric, 1.0 / double{size});
    const CostCurve expected = simplify::cost_curve(mesh, {});
    ASSERT_EQ(curve.size(), expected.size()) << size;
    for (std::size_t i = 0; i < curve.size(); ++i) {
      EXPECT_NEAR(curve[i].cost / expected[i].cost, 1.0, 0.03) << size;
      EXPECT_EQ(curve[i].faces, expected[i].faces) << size;
    }
  }
}

TEST(CostCurve, RemovalsCanBeLimited) {
  CostCurve curve{{1.0, 10, 5}, {2.0, 6, 3}, {3.0, 4, 2}};
  simplify::limit_removals(curve, 14);
  ASSERT_EQ(curve.size(), 2U);
  EXPECT_EQ(simplify::removable_faces(curve), 14U);
  EXPECT_EQ(curve[1].removals, 2U);
  simplify::limit_removals(curve, 0);
  EXPECT_TRUE(curve.empty());
}

TEST(Budget, IsMetExactlyWhereCollapsesAllow) {
  const std::vector<BudgetItem> items{{100, 1, {{1.0, 40, 20}, {4.0, 40, 20}}},
                                      {100, 1, {{2.0, 40, 20}, {3.0, 40, 20}}}};
  EXPECT_EQ(simplify::distribute(items, 200), (std::vector<std::uint32_t>{100, 100}));
  EXPECT_EQ(simplify::distribute(items, 300), (std::vector<std::uint32_t>{100, 100}));
  EXPECT_EQ(simplify::distribute(items, 160), (std::vector<std::uint32_t>{60, 100}));
  EXPECT_EQ(simplify::distribute(items, 130), (std::vector<std::uint32_t>{60, 70}));
  EXPECT_EQ(simplify::distribute(items, 129), (std::vector<std::uint32_t>{60, 68}));
  EXPECT_EQ(simplify::distribute(items, 70), (std::vector<std::uint32_t>{50, 20}));
  EXPECT_EQ(simplify::distribute(items, 1), (std::vector<std::uint32_t>{20, 20})) << "no further";
  EXPECT_TRUE(simplify::distribute({}, 10).empty());
}

// The last removal of a mesh that is shown fifty times takes a hundred faces from the screen. What
// is too much is given back to the others.
TEST(Budget, GivesBackWhatTheLastRemovalTookTooMuch) {
  const std::vector<BudgetItem> items{{100, 1, {{1.0, 60, 30}}}, {100, 50, {{2.0, 40, 20}}}};
  EXPECT_EQ(simplify::distribute(items, 5'030), (std::vector<std::uint32_t>{100, 98}))
      << "5,040 are too many, and 4,940 are 90 too few, of which 60 can be given back";
}

TEST(Budget, LargerSphereKeepsMoreFaces) {
  const Mesh sphere = built(torus(60, 40)).mesh;
  const std::vector<BudgetItem> items{item_of(sphere, 1, 4.0), item_of(sphere, 1, 1.0)};
  const std::vector<std::uint32_t> counts = simplify::distribute(items, 1'000);
  EXPECT_NEAR(counts[0] + counts[1], 1'000, 2);
  EXPECT_GT(counts[0], 3 * counts[1]);
  EXPECT_GT(counts[1], 40U) << "the small one gets what it deserves";
  // The sum of area-weighted squared errors is less than with the same share for both.
  const auto sum = [&](std::uint32_t large, std::uint32_t small) {
    return 16.0 * std::pow(4.0 * error_at(sphere, large), 2) + std::pow(error_at(sphere, small), 2);
  };
  EXPECT_LT(sum(counts[0], counts[1]), 0.6 * sum(500, 500));
}

TEST(Budget, NumberOfInstancesDoesNotChangeTheOrder) {
  const Mesh mesh = built(torus(60, 40)).mesh;
  const std::vector<BudgetItem> items{item_of(mesh, 7), item_of(mesh, 1)};
  const std::vector<std::uint32_t> counts = simplify::distribute(items, 8 * 600);
  EXPECT_LE(7 * counts[0] + counts[1], 8 * 600U);
  EXPECT_NEAR(counts[0], 600, 20);
  EXPECT_NEAR(counts[1], 600, 60);
}

TEST(Budget, MinimalMeshKeepsItsFaces) {
  const std::vector<BudgetItem> items{item_of(built(tetrahedron()).mesh),
                                      item_of(built(torus(30, 20)).mesh)};
  EXPECT_TRUE(items[0].curve.empty());
  EXPECT_EQ(simplify::distribute(items, 204), (std::vector<std::uint32_t>{4, 200}));
}

TEST(Budget, FlatMeshCostsNothing) {
  const std::vector<BudgetItem> items{item_of(built(grid(30)).mesh),
                                      item_of(built(torus(60, 40)).mesh)};
  const std::vector<std::uint32_t> counts = simplify::distribute(items, 4'900);
  EXPECT_NEAR(counts[1], 4'800, 8) << "the torus loses nothing, or hardly anything";
  EXPECT_NEAR(counts[0] + counts[1], 4'900, 2);
}

TEST(Budget, CostsOfOtherPoliciesHaveTheirOwnUnits) {
  for (const simplify::CostPolicy policy :
       {simplify::CostPolicy::edge_length, simplify::CostPolicy::shape}) {
    CostCurve curve{{1.0, 2, 1}};
    simplify::scale_costs(curve, policy, 3.0);
    EXPECT_DOUBLE_EQ(curve[0].cost, 9.0);
  }
  CostCurve curve{{1.0, 2, 1}};
  simplify::scale_costs(curve, simplify::CostPolicy::random, 3.0);
  EXPECT_EQ(curve[0].cost, 1.0);
}

}  // namespace
}  // namespace mesher::test
