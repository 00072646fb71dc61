#include "engine/analysis/triangle_tree.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "tests/support/meshes.h"

namespace mesher::test {
namespace {

using Triangle = std::array<glm::dvec3, 3>;

const Triangle kTriangle{glm::dvec3(0, 0, 0), glm::dvec3(4, 0, 0), glm::dvec3(0, 3, 0)};

TEST(SquaredDistance, MeasuresToFaceSidesAndCorners) {
  EXPECT_DOUBLE_EQ(analysis::squared_distance({1, 1, 5}, kTriangle), 25.0);
  EXPECT_DOUBLE_EQ(analysis::squared_distance({1, 1, -5}, kTriangle), 25.0);
  EXPECT_DOUBLE_EQ(analysis::squared_distance({1, 1, 0}, kTriangle), 0.0);
  EXPECT_DOUBLE_EQ(analysis::squared_distance({2, -3, 0}, kTriangle), 9.0);
  EXPECT_DOUBLE_EQ(analysis::squared_distance({-3, -4, 0}, kTriangle), 25.0);
  EXPECT_DOUBLE_EQ(analysis::squared_distance({7, 0, 4}, kTriangle), 25.0);
  EXPECT_DOUBLE_EQ(analysis::squared_distance({4, 3, 0}, kTriangle),
                   5.76);  // to the long side: 12/5
}

TEST(SquaredDistance, HandlesZeroAreaTriangles) {
  const Triangle needle{glm::dvec3(0, 0, 0), glm::dvec3(2, 0, 0), glm::dvec3(5, 0, 0)};
  EXPECT_DOUBLE_EQ(analysis::squared_distance({4, 3, 0}, needle), 9.0);
  EXPECT_DOUBLE_EQ(analysis::squared_distance({8, 4, 0}, needle), 25.0);
  const Triangle point{glm::dvec3(1), glm::dvec3(1), glm::dvec3(1)};
  EXPECT_DOUBLE_EQ(analysis::squared_distance({1, 1, 3}, point), 4.0);
}

TEST(TriangleTree, AgreesWithBruteForce) {
  std::mt19937 random(2);
  const auto coordinate = [&] { return static_cast<float>(random() % 2000) / 100.0F - 10.0F; };
  for (const Soup& soup : {cube(), torus(13, 9), grid(7), tetrahedron()}) {
    const Mesh mesh = built(Soup(soup)).mesh;
    const analysis::TriangleTree tree(mesh);
    for (int i = 0; i < 300; ++i) {
      const glm::dvec3 p(coordinate() / 3, coordinate() / 3, coordinate() / 3);
      double least = 1e300;
      for (std::uint32_t f = 0; f < mesh.face_count(); ++f) {
        Triangle t;
        for (std::uint32_t c = 0; c < 3; ++c) {
          t[c] = mesh.position(mesh.origin(Mesh::halfedge(Face(f), c)));
        }
        least = std::min(least, analysis::squared_distance(p, t));
      }
      const Face hint(static_cast<std::uint32_t>(random() % mesh.face_count()));
      EXPECT_EQ(tree.nearest(p, hint).squared_distance, least);
      EXPECT_EQ(tree.nearest(p).squared_distance, least);
    }
  }
}

TEST(TriangleTree, CoincidentTrianglesKeepTheTreeShallow) {
  Soup soup;
  for (std::uint32_t i = 0; i < 30'000; ++i) {
    const auto base = static_cast<std::uint32_t>(soup.positions.size());
    for (const glm::vec3 p : {glm::vec3(0, 0, 0), {1, 0, 0}, {0, 1, 0}})
      soup.positions.push_back(p);
    soup.corners.insert(soup.corners.end(), {base, base + 1, base + 2});
  }
  const analysis::TriangleTree tree(built(std::move(soup)).mesh);
  EXPECT_DOUBLE_EQ(tree.nearest({0.25, 0.25, 2.0}).squared_distance, 4.0);
}

}  // namespace
}  // namespace mesher::test
