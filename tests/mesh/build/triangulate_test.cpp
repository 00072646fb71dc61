#include "engine/mesh/build/triangulate.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <random>

#include "tests/support/meshes.h"
#include "tests/support/sanitized.h"

namespace mesher::test {
namespace {

using Triangle = std::array<std::uint32_t, 3>;

double cross_z(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c) {
  return (double(b.x) - a.x) * (double(c.y) - a.y) - (double(b.y) - a.y) * (double(c.x) - a.x);
}

double signed_area(const std::vector<glm::vec3>& p) {
  double sum = 0.0;
  for (std::size_t i = 0; i < p.size(); ++i) {
    const glm::vec3& a = p[i];
    const glm::vec3& b = p[(i + 1) % p.size()];
    sum += 0.5 * (double(a.x) * b.y - double(a.y) * b.x);
  }
  return sum;
}

std::vector<Triangle> triangles_of(const std::vector<glm::vec3>& polygon) {
  std::vector<Triangle> triangles;
  triangulate(polygon, triangles);
  return triangles;
}

/// Checks the triangles of a simple polygon in the plane z = 0: there are n-2, none is flipped, and
/// their areas add up. So none overlap and none lie outside.
void expect_exact_cover(const std::vector<glm::vec3>& polygon) {
  const auto triangles = triangles_of(polygon);
  ASSERT_EQ(triangles.size(), polygon.size() - 2);
  const double sign = signed_area(polygon) < 0 ? -1.0 : 1.0;
  double sum = 0.0;
  for (const auto& [a, b, c] : triangles) {
    const double area = 0.5 * cross_z(polygon[a], polygon[b], polygon[c]);
    EXPECT_GE(sign * area, 0.0);
    sum += area;
  }
  EXPECT_NEAR(sum, signed_area(polygon), 1e-9 * std::abs(signed_area(polygon)));
}

std::vector<glm::vec3> star(std::uint32_t n, double inner) {
  std::vector<glm::vec3> p;
  for (std::uint32_t i = 0; i < n; ++i) {
    const double a = 2.0 * std::acos(-1.0) * i / n;
    const double r = i % 2 == 0 ? 1.0 : inner;
    p.push_back({float(r * std::cos(a)), float(r * std::sin(a)), 0.0F});
  }
  return p;
}

TEST(Triangulate, ConvexQuadUsesTheShorterDiagonal) {
  const auto t = triangles_of({{0, 0, 0}, {3, -1, 0}, {6, 0, 0}, {3, 1, 0}});
  EXPECT_EQ(t, (std::vector<Triangle>{{0, 1, 3}, {1, 2, 3}}));
}

TEST(Triangulate, ConcaveQuadUsesTheInnerDiagonal) {
  for (int turn = 0; turn < 4; ++turn) {
    const std::vector<glm::vec3> arrow{{0, 0, 0}, {2, 1, 0}, {0, 2, 0}, {1.5F, 1, 0}};
    std::vector<glm::vec3> p;
    for (int i = 0; i < 4; ++i)
      p.push_back(arrow[(i + turn) % 4]);
    expect_exact_cover(p);
    std::reverse(p.begin(), p.end());
    expect_exact_cover(p);
  }
}

TEST(Triangulate, ConcavePolygonsAreCoveredExactly) {
  expect_exact_cover(
      {{0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {3, 4, 0}, {3, 1, 0}, {1, 1, 0}, {1, 4, 0}, {0, 4, 0}});
  for (const std::uint32_t n : {6U, 10U, 64U, 1000U, 20'000U})
    expect_exact_cover(star(n, 0.3));
}

TEST(Triangulate, CollinearCornersAreAccepted) {
  expect_exact_cover(
      {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}, {3, 3, 0}, {2, 3, 0}, {0, 3, 0}, {0, 1, 0}});
}

TEST(Triangulate, HoleConnectedByABridgeStaysOpen) {
  expect_exact_cover({{0, 0, 0},
                      {6, 0, 0},
                      {6, 6, 0},
                      {0, 6, 0},
                      {0, 0, 0},
                      {2, 2, 0},
                      {2, 4, 0},
                      {4, 4, 0},
                      {4, 2, 0},
                      {2, 2, 0}});
}

TEST(Triangulate, RandomSpiralsAreCoveredExactly) {
  std::mt19937 random(3);
  for (int trial = 0; trial < 200; ++trial) {
    std::vector<glm::vec3> p;  // star-shaped around 0, so simple for any radii
    const auto n = 5 + random() % 60;
    for (std::uint32_t i = 0; i < n; ++i) {
      const double a = 2.0 * std::acos(-1.0) * i / double(n);
      const double r = 0.05 + double(random() % 1000) / 1000.0;
      p.push_back({float(r * std::cos(a)), float(r * std::sin(a)), 0.0F});
    }
    expect_exact_cover(p);
  }
}

TEST(Triangulate, WorksInAnyPlaneAndKeepsTheOrientation) {
  const auto flat = star(14, 0.4);
  for (const auto& [u, v] : {std::pair{glm::vec3(0, 1, 0), glm::vec3(0, 0, 1)},
                             {glm::vec3(0, 0, 1), glm::vec3(1, 0, 0)},
                             {glm::vec3(0, 1, 0), glm::vec3(1, 0, 0)},
                             {glm::vec3(1, 1, 0), glm::vec3(0, 1, 1)}}) {
    std::vector<glm::vec3> p;
    for (const glm::vec3& q : flat)
      p.push_back(q.x * u + q.y * v + glm::vec3(100, 200, 300));
    const glm::vec3 normal = glm::cross(u, v);
    for (const auto& [a, b, c] : triangles_of(p)) {
      EXPECT_GT(glm::dot(glm::cross(p[b] - p[a], p[c] - p[a]), normal), 0.0F);
    }
  }
}

TEST(Triangulate, SelfIntersectingPolygonTerminates) {
  std::mt19937 random(11);
  for (int trial = 0; trial < 300; ++trial) {
    std::vector<glm::vec3> p(3 + random() % 40);
    for (glm::vec3& q : p)
      q = {float(random() % 8), float(random() % 8), float(random() % 8)};
    const auto triangles = triangles_of(p);
    ASSERT_EQ(triangles.size(), p.size() - 2);
    for (const Triangle& t : triangles) {
      for (const std::uint32_t i : t)
        EXPECT_LT(i, p.size());
    }
  }
}

TEST(Triangulate, MillionCornersTakeReasonableTime) {
  expect_exact_cover(star(kSanitized ? 100'000 : 1'000'000, 0.9));
  std::mt19937 random(5);
  std::vector<glm::vec3> scribble(kSanitized ? 20'000 : 200'000);
  for (glm::vec3& q : scribble)
    q = {float(random() % 1000), float(random() % 1000), 0.0F};
  EXPECT_EQ(triangles_of(scribble).size(), scribble.size() - 2);
}

// The worst that a hostile file can do per byte: many polygons that intersect themselves
// everywhere.
TEST(Triangulate, ManySelfIntersectingPolygonsTakeLinearTime) {
  std::mt19937 random(6);
  for (int i = 0; i < 200; ++i) {
    std::vector<glm::vec3> scribble(1000);
    for (glm::vec3& q : scribble)
      q = {float(random() % 1000), float(random() % 1000), 0.0F};
    EXPECT_EQ(triangles_of(scribble).size(), scribble.size() - 2);
  }
}

TEST(Triangulate, NonFiniteCornersGiveAFan) {
  const float nan = std::nanf("");
  EXPECT_EQ(triangles_of({{0, 0, 0}, {nan, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 2, 0}}).size(), 3U);
}

TEST(Triangulate, SoupKeepsAttributesAndCountsRepairs) {
  Soup soup =
      soup_of({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {2, 0, 0}}, {0, 1, 2, 3, 1, 4, 2, 0, 1});
  soup.face_start.assign({0, 4, 7, 9});
  for (std::uint32_t i = 0; i < 9; ++i)
    soup.attributes.texcoord.push_back({float(i), 0.0F});
  soup.attributes.group.assign({5, 6, 7});
  to_streams(soup);
  BuildReport report;
  triangulate(soup, report);
  EXPECT_EQ(report[Repair::polygons_triangulated], 1U);
  EXPECT_EQ(report[Repair::degenerate_faces_dropped], 1U);
  ASSERT_EQ(soup.corners.size(), 9U);
  EXPECT_TRUE(soup.face_start.empty());
  EXPECT_EQ(soup.attributes.group, (Array<std::uint32_t>{5, 5, 6}));
  const Array<std::uint32_t> expected_last{1, 4, 2};
  EXPECT_TRUE(std::equal(expected_last.begin(), expected_last.end(), soup.corners.begin() + 6));
  const AttributeStream& stream = soup.streams.at(0);
  EXPECT_EQ(stream.layers.at(0).values<glm::vec2>()[stream.index[6]].x, 4.0F);
}

}  // namespace
}  // namespace mesher::test
