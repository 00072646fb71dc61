#include "engine/analysis/skim.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <glm/geometric.hpp>
#include <vector>

#include "engine/analysis/triangle_tree.h"
#include "tests/support/meshes.h"

namespace mesher::test {
namespace {

constexpr std::uint32_t kSize = 32;
constexpr double kAllowed = 0.1;

/// One triangle over half of a grid of kSize squares, a little above it.
Mesh wide_face() {
  Soup soup;
  soup.positions = {{0.3F, 0.3F, 0.02F}, {31.3F, 0.3F, 0.02F}, {0.3F, 31.3F, 0.02F}};
  soup.corners = {0, 1, 2};
  return built(std::move(soup)).mesh;
}

/// The grid with a ridge above x = 10, which slopes down to 9 and 11.
Mesh sheet_with_ridge(float height) {
  Soup soup = grid(kSize);
  for (glm::vec3& p : soup.positions) {
    if (p.x == 10.0F) p.z = height;
  }
  return built(std::move(soup)).mesh;
}

analysis::Skimmed skimmed(const Mesh& from, const Mesh& to) {
  const std::vector<Face> hints{Face(2 * (8 * kSize + 8))};
  const std::vector<std::uint8_t> is_near(from.vertex_count(), 0);
  return analysis::skim({.from = from,
                         .to = to,
                         .hints = hints,
                         .only = {},
                         .is_near = is_near,
                         .near = 0.0,
                         .rounding = 1e-12},
                        kAllowed, nullptr);
}

double area(const analysis::Triangle& t) {
  return 0.5 * glm::length(glm::cross(t[1] - t[0], t[2] - t[0]));
}

bool contains(const analysis::Triangle& t, double x, double y) {
  const auto side = [&](std::size_t c) {
    const glm::dvec3& a = t[c];
    const glm::dvec3& b = t[(c + 1) % 3];
    return (b.x - a.x) * (y - a.y) - (b.y - a.y) * (x - a.x);
  };
  const std::array<double, 3> sides{side(0), side(1), side(2)};
  return std::ranges::all_of(sides, [](double s) { return s >= -1e-9; }) ||
         std::ranges::all_of(sides, [](double s) { return s <= 1e-9; });
}

TEST(Skim, SettlesAFaceOverAFlatSheet) {
  const analysis::Skimmed result = skimmed(wide_face(), sheet_with_ridge(0.0F));
  EXPECT_TRUE(result.unclear.empty());
  EXPECT_GE(result.upper, 0.0199);
  EXPECT_LE(result.upper, kAllowed);
}

// What is left covers every point that is too far away, and little more than the ridge.
TEST(Skim, LeavesTheStripAlongARidge) {
  const Mesh from = wide_face();
  const Mesh to = sheet_with_ridge(3.0F);
  const analysis::Skimmed result = skimmed(from, to);
  ASSERT_FALSE(result.unclear.empty());
  EXPECT_LE(result.upper, kAllowed);
  double left = 0.0;
  for (const analysis::Skimmed::Unclear& unclear : result.unclear) {
    EXPECT_EQ(unclear.face, Face(0));
    ASSERT_TRUE(unclear.part.has_value());
    EXPECT_GT(unclear.upper, kAllowed);
    left += area(*unclear.part);
  }
  EXPECT_LT(left, 0.3 * 0.5 * 31.0 * 31.0);
  const analysis::TriangleTree tree(to);
  int far = 0;
  for (int i = 1; i < 200; ++i) {
    for (int k = 1; i + k < 200; ++k) {
      const glm::dvec3 p(0.3 + 31.0 * i / 200.0, 0.3 + 31.0 * k / 200.0, 0.02);
      const double d = tree.nearest_beyond(p, Face(0), 0.0).squared_distance;
      if (d <= kAllowed * kAllowed) continue;
      ++far;
      EXPECT_TRUE(std::ranges::any_of(
          result.unclear,
          [&](const analysis::Skimmed::Unclear& u) { return contains(*u.part, p.x, p.y); }))
          << p.x << ", " << p.y;
    }
  }
  EXPECT_GT(far, 100);
}

TEST(Skim, KeepsAFaceWholeThatIsTooFarAwayEverywhere) {
  Soup soup = grid(kSize);
  for (glm::vec3& p : soup.positions)
    p.z = -1.0F;
  const analysis::Skimmed result = skimmed(wide_face(), built(std::move(soup)).mesh);
  ASSERT_EQ(result.unclear.size(), 1U);
  EXPECT_FALSE(result.unclear[0].part.has_value());
}

}  // namespace
}  // namespace mesher::test
