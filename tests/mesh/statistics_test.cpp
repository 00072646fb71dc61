#include "engine/mesh/statistics.h"

#include <gtest/gtest.h>

#include "tests/support/meshes.h"

namespace mesher::test {
namespace {

TEST(Statistics, Cube) {
  const Statistics s = statistics(built(cube()).mesh);
  EXPECT_EQ(s.vertices, 8U);
  EXPECT_EQ(s.edges, 18U);
  EXPECT_EQ(s.faces, 12U);
  EXPECT_EQ(s.components, 1U);
  EXPECT_EQ(s.boundary_loops, 0U);
  EXPECT_TRUE(s.is_closed());
  EXPECT_NEAR(s.area, 6.0, 1e-12);
  EXPECT_NEAR(s.volume, 1.0, 1e-12);
  EXPECT_NEAR(s.box.diagonal(), std::sqrt(3.0), 1e-12);
}

TEST(Statistics, FlatSheet) {
  const Statistics s = statistics(built(grid(5)).mesh);
  EXPECT_EQ(s.boundary_edges, 20U);
  EXPECT_EQ(s.boundary_loops, 1U);
  EXPECT_EQ(s.euler_characteristic, 1);
  EXPECT_NEAR(s.area, 25.0, 1e-9);
}

TEST(Statistics, VolumeIsAccurateFarFromTheOrigin) {
  Soup soup = cube();
  for (glm::vec3& p : soup.positions)
    p += glm::vec3(262144.0F, -262144.0F, 0.0F);
  EXPECT_NEAR(statistics(built(std::move(soup)).mesh).volume, 1.0, 1e-9);
}

TEST(Statistics, CountsComponentsAndLoopsOfSeveralParts) {
  const Mesh mesh = built(join(join(cube(), grid(2), {5, 0, 0}), torus(8, 6), {0, 20, 0})).mesh;
  const Statistics s = statistics(mesh);
  EXPECT_EQ(s.components, 3U);
  EXPECT_EQ(s.boundary_loops, 1U);
  EXPECT_EQ(s.euler_characteristic, 2 + 1 + 0);
}

TEST(Statistics, BoundaryLoopsFollowTheBoundary) {
  const Mesh mesh = built(grid(4)).mesh;
  const auto loops = boundary_loops(mesh);
  ASSERT_EQ(loops.size(), 1U);
  ASSERT_EQ(loops[0].size(), 16U);
  for (std::size_t i = 0; i < loops[0].size(); ++i) {
    EXPECT_TRUE(mesh.is_boundary(loops[0][i]));
    EXPECT_EQ(mesh.target(loops[0][i]), mesh.origin(loops[0][(i + 1) % loops[0].size()]));
  }
}

TEST(Statistics, CountsIsolatedVerticesAndZeroAreaFaces) {
  Soup soup = soup_of({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {9, 9, 9}}, {0, 1, 2});
  const Statistics s = statistics(built(std::move(soup), {.keep_isolated_vertices = true}).mesh);
  EXPECT_EQ(s.isolated_vertices, 1U);
  EXPECT_EQ(s.zero_area_faces, 1U);
  EXPECT_EQ(s.euler_characteristic, 1);
}

TEST(Statistics, EmptyMesh) {
  const Statistics s = statistics(built({}).mesh);
  EXPECT_EQ(s.components, 0U);
  EXPECT_TRUE(s.box.is_empty());
  EXPECT_EQ(s.box.diagonal(), 0.0);
}

TEST(Box, DiagonalOfAHugeBoxDoesNotOverflow) {
  const Box box{glm::vec3(-3e38F), glm::vec3(3e38F)};
  EXPECT_TRUE(std::isfinite(box.diagonal()));
}

}  // namespace
}  // namespace mesher::test
