#include "engine/mesh/statistics.h"

#include <gtest/gtest.h>

#include <set>

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

/// Follows the boundary edge by edge.
std::uint32_t loops_by_definition(const Mesh& mesh) {
  std::set<std::uint32_t> left;
  for (std::uint32_t h = 0; h < mesh.halfedge_count(); ++h) {
    if (mesh.is_boundary(Halfedge(h))) left.insert(h);
  }
  std::uint32_t loops = 0;
  while (!left.empty()) {
    ++loops;
    Halfedge h(*left.begin());
    while (left.erase(h.index()) > 0) {
      Halfedge next = Mesh::next(h);
      while (!mesh.is_boundary(next))
        next = Mesh::next(mesh.twin(next));
      h = next;
    }
  }
  return loops;
}

/// A grid without every third face, so that many holes meet at their corners.
Mesh grid_with_holes(std::size_t every) {
  Soup soup = grid(12);
  std::vector<std::uint32_t> kept;
  for (std::size_t f = 0; f < soup.corners.size() / 3; ++f) {
    if (f % every == 1) continue;
    for (std::size_t c = 0; c < 3; ++c)
      kept.push_back(soup.corners[3 * f + c]);
  }
  soup.corners.assign(kept.begin(), kept.end());
  return built(std::move(soup)).mesh;
}

TEST(Statistics, BoundaryLoopsAreThoseOfTheDefinition) {
  EXPECT_EQ(count_boundary_loops(built(grid(4)).mesh), 1U);
  EXPECT_EQ(count_boundary_loops(built(cube()).mesh), 0U);
  for (const std::size_t every : {2U, 3U, 5U, 7U, 50U}) {
    SCOPED_TRACE(every);
    const Mesh mesh = grid_with_holes(every);
    EXPECT_GT(count_boundary_loops(mesh), 0U);
    EXPECT_EQ(count_boundary_loops(mesh), loops_by_definition(mesh));
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
