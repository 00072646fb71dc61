#include "engine/mesh/creases.h"

#include <gtest/gtest.h>

#include "engine/mesh/statistics.h"
#include "tests/support/meshes.h"

namespace mesher::test {
namespace {

constexpr float kDegree = 3.14159265F / 180.0F;

TEST(Creases, TagsTheEdgesOfACubeAndNotItsDiagonals) {
  Mesh mesh = built(cube()).mesh;
  EXPECT_EQ(tag_creases_by_angle(mesh, 45.0F * kDegree), 12U);
  expect_valid(mesh);
  EXPECT_EQ(statistics(mesh).crease_edges, 12U);
}

TEST(Creases, NothingIsSharperThanAFold) {
  Mesh mesh = built(cube()).mesh;
  EXPECT_EQ(tag_creases_by_angle(mesh, 179.0F * kDegree), 0U);
}

TEST(Creases, DihedralAngleOfACubeEdgeIsAQuarterTurn) {
  const Mesh mesh = built(cube()).mesh;
  EXPECT_NEAR(dihedral_angle_rad(mesh, mesh.find_edge(Vertex(0), Vertex(1))), 90 * kDegree, 1e-6);
  EXPECT_NEAR(dihedral_angle_rad(mesh, mesh.find_edge(Vertex(0), Vertex(2))), 0.0, 1e-6);
}

TEST(Creases, ABoundaryEdgeHasNoAngle) {
  Mesh mesh = built(grid(2)).mesh;
  EXPECT_EQ(dihedral_angle_rad(mesh, mesh.find_edge(Vertex(0), Vertex(1))), 0.0F);
  EXPECT_EQ(tag_creases_by_angle(mesh, 0.0F), 0U);
}

}  // namespace
}  // namespace mesher::test
