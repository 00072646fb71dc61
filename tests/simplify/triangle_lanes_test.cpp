#include "engine/simplify/triangle_lanes.h"

#include <gtest/gtest.h>

#include <array>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <random>

#include "engine/analysis/triangle_tree.h"

namespace mesher::test {
namespace {

using Triangle = std::array<glm::dvec3, 3>;

/// Squared distances to four triangles, one per lane.
Float4 squared_distances_of(const glm::dvec3& p, const std::array<Triangle, 4>& triangles) {
  simplify::TriangleLanes lanes{};
  const auto set = [](Vec3<Float4>& to, std::size_t lane, const glm::dvec3& v) {
    simplify::set_lane(to, lane,
                       {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)});
  };
  for (std::size_t lane = 0; lane < 4; ++lane) {
    set(lanes.a, lane, triangles[lane][0]);
    set(lanes.b, lane, triangles[lane][1]);
    set(lanes.c, lane, triangles[lane][2]);
  }
  Vec3<Float4> point{};
  for (std::size_t lane = 0; lane < 4; ++lane)
    set(point, lane, p);
  return simplify::squared_distances(point, lanes);
}

class RandomTriangles {
 public:
  glm::dvec3 point() { return {number_(engine_), number_(engine_), number_(engine_)}; }
  Triangle triangle() { return {point(), point(), point()}; }
  /// A needle whose third corner is almost on its first side.
  Triangle needle() {
    Triangle t = triangle();
    t[2] = 0.5 * (t[0] + t[1]) + 1e-4 * point();
    return t;
  }

 private:
  std::mt19937 engine_{7};
  std::uniform_real_distribution<float> number_{-1.0F, 1.0F};
};

TEST(TriangleLanes, AgreeWithDoublePrecision) {
  RandomTriangles random;
  for (int i = 0; i < 20'000; ++i) {
    const std::array<Triangle, 4> four{random.triangle(), random.triangle(), random.triangle(),
                                       random.needle()};
    const glm::dvec3 p = random.point();
    const Float4 found = squared_distances_of(p, four);
    for (std::size_t lane = 0; lane < 4; ++lane)
      ASSERT_NEAR(double{found[lane]}, analysis::squared_distance(p, four[lane]), 2e-5) << i;
  }
}

TEST(TriangleLanes, PointOnTheTriangleHasZeroDistance) {
  const Triangle t{glm::dvec3(0, 0, 0), glm::dvec3(4, 0, 0), glm::dvec3(0, 4, 0)};
  EXPECT_EQ(squared_distances_of({1, 1, 0}, {t, t, t, t})[2], 0.0F);
  EXPECT_EQ(squared_distances_of({1, 1, 3}, {t, t, t, t})[1], 9.0F);
  EXPECT_EQ(squared_distances_of({7, 0, 4}, {t, t, t, t})[0], 25.0F);
}

TEST(TriangleLanes, ZeroAreaTriangleMeasuresToItsSides) {
  const Triangle line{glm::dvec3(0, 0, 0), glm::dvec3(2, 0, 0), glm::dvec3(1, 0, 0)};
  const Triangle dot{glm::dvec3(1, 1, 1), glm::dvec3(1, 1, 1), glm::dvec3(1, 1, 1)};
  const Float4 found = squared_distances_of({1, 3, 0}, {line, dot, line, dot});
  EXPECT_FLOAT_EQ(found[0], 9.0F);
  EXPECT_FLOAT_EQ(found[1], 5.0F);
  EXPECT_FLOAT_EQ(simplify::least_of(found), 5.0F);
}

}  // namespace
}  // namespace mesher::test
