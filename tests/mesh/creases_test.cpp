#include "engine/mesh/creases.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "engine/mesh/delta.h"
#include "engine/mesh/statistics.h"
#include "tests/support/meshes.h"

namespace mesher::test {
namespace {

constexpr float kDegree = 3.14159265F / 180.0F;

TEST(Creases, TagsCubeEdgesButNotDiagonals) {
  Mesh mesh = built(cube()).mesh;
  EXPECT_EQ(tag_creases_by_angle(mesh, 45.0F * kDegree), 12U);
  expect_valid(mesh);
  EXPECT_EQ(statistics(mesh).crease_edges, 12U);
}

TEST(Creases, LargeAngleTagsNothing) {
  Mesh mesh = built(cube()).mesh;
  EXPECT_EQ(tag_creases_by_angle(mesh, 179.0F * kDegree), 0U);
}

TEST(Creases, DihedralAngleOfCubeEdgeIs90Degrees) {
  const Mesh mesh = built(cube()).mesh;
  EXPECT_NEAR(dihedral_angle_rad(mesh, mesh.find_edge(Vertex(0), Vertex(1))), 90 * kDegree, 1e-6);
  EXPECT_NEAR(dihedral_angle_rad(mesh, mesh.find_edge(Vertex(0), Vertex(2))), 0.0, 1e-6);
}

TEST(Creases, BoundaryEdgeHasZeroAngle) {
  Mesh mesh = built(grid(2)).mesh;
  EXPECT_EQ(dihedral_angle_rad(mesh, mesh.find_edge(Vertex(0), Vertex(1))), 0.0F);
  EXPECT_EQ(tag_creases_by_angle(mesh, 0.0F), 0U);
}

std::vector<Edge> sorted(std::vector<Edge> edges) {
  std::sort(edges.begin(), edges.end());
  return edges;
}

/// Vertex (x, y) of grid(n).
Vertex at(std::uint32_t n, std::uint32_t x, std::uint32_t y) {
  return Vertex(y * (n + 1) + x);
}

TEST(Creases, UntaggedEdgesAreThoseThatTaggingWouldChange) {
  Mesh mesh = built(cube()).mesh;
  mesh.set_sharpness(mesh.find_edge(Vertex(0), Vertex(1)), 2.0F);
  mesh.set_sharpness(mesh.find_edge(Vertex(1), Vertex(2)), kInfinitelySharp);
  const std::vector<Edge> untagged = untagged_edges_beyond(mesh, 45.0F * kDegree);
  EXPECT_EQ(untagged.size(), 11U);
  EXPECT_TRUE(std::is_sorted(untagged.begin(), untagged.end()));
  EXPECT_EQ(sharp_edges(mesh).size(), 2U);
  tag_creases_by_angle(mesh, 45.0F * kDegree);
  EXPECT_TRUE(untagged_edges_beyond(mesh, 45.0F * kDegree).empty());
  EXPECT_EQ(sharp_edges(mesh).size(), 12U);
}

TEST(CreaseChain, SmoothChainRunsStraightBetweenBoundaries) {
  const Mesh mesh = built(grid(6)).mesh;
  const Edge start = mesh.find_edge(at(6, 2, 3), at(6, 3, 3));
  const std::vector<Edge> chain = crease_chain(mesh, start);
  ASSERT_EQ(chain.size(), 6U);
  for (const Edge e : chain) {
    const Halfedge h = Mesh::halfedge(e);
    EXPECT_EQ(mesh.position(mesh.origin(h)).y, 3.0F);
    EXPECT_EQ(mesh.position(mesh.target(h)).y, 3.0F);
    EXPECT_EQ(sorted(crease_chain(mesh, e)), sorted(chain))
        << "every edge of the chain gives the same chain";
  }
  for (std::size_t i = 1; i < chain.size(); ++i) {  // the edges are in order
    const auto x = [&](Edge e) {
      const Halfedge h = Mesh::halfedge(e);
      return mesh.position(mesh.origin(h)).x + mesh.position(mesh.target(h)).x;
    };
    EXPECT_EQ(std::abs(x(chain[i]) - x(chain[i - 1])), 2.0F);
  }
}

TEST(CreaseChain, SmoothChainClosesAroundTorus) {
  const Mesh mesh = built(torus(24, 10)).mesh;
  const Edge around = mesh.find_edge(Vertex(0), Vertex(10));  // 15 degrees per edge
  EXPECT_EQ(crease_chain(mesh, around).size(), 24U);
  const Edge across = mesh.find_edge(Vertex(0), Vertex(1));  // 36 degrees per edge
  EXPECT_EQ(crease_chain(mesh, across).size(), 10U);
  EXPECT_EQ(crease_chain(mesh, across, 30.0F * kDegree).size(), 1U) << "the chain turns too much";
}

TEST(CreaseChain, SharpChainFollowsCornersAndEndsAtJunctions) {
  Mesh mesh = built(grid(6)).mesh;
  // A square with a tail at one corner, which makes that corner a junction.
  const auto sharpen = [&](std::uint32_t x0, std::uint32_t y0, std::uint32_t x1, std::uint32_t y1) {
    mesh.set_sharpness(mesh.find_edge(at(6, x0, y0), at(6, x1, y1)), 2.0F);
  };
  sharpen(2, 2, 3, 2);
  sharpen(3, 2, 3, 3);
  sharpen(3, 3, 2, 3);
  sharpen(2, 3, 2, 2);
  const Edge side = mesh.find_edge(at(6, 3, 2), at(6, 3, 3));
  const std::vector<Edge> loop = sorted(crease_chain(mesh, side));
  EXPECT_EQ(loop, sharp_edges(mesh)) << "a loop with each edge once";
  sharpen(2, 2, 1, 2);
  EXPECT_EQ(sorted(crease_chain(mesh, side)), loop) << "from the junction back to the junction";
  EXPECT_EQ(crease_chain(mesh, mesh.find_edge(at(6, 1, 2), at(6, 2, 2))).size(), 1U);
  const Edge beyond = mesh.find_edge(at(6, 4, 2), at(6, 5, 2));
  EXPECT_EQ(crease_chain(mesh, beyond).size(), 3U)
      << "the chain of smooth edges ends at the crease";
}

TEST(CreaseChain, CubeEdgeIsItsOwnChain) {
  Mesh mesh = built(cube()).mesh;
  const Edge e = mesh.find_edge(Vertex(0), Vertex(1));
  EXPECT_EQ(crease_chain(mesh, e), std::vector<Edge>{e});
  tag_creases_by_angle(mesh, 45.0F * kDegree);
  EXPECT_EQ(crease_chain(mesh, e), std::vector<Edge>{e}) << "three creases meet at each end";
}

TEST(CreaseChain, BoundaryEdgeIsItsOwnChain) {
  const Mesh mesh = built(grid(4)).mesh;
  const Edge e = mesh.find_edge(at(4, 1, 0), at(4, 2, 0));
  EXPECT_EQ(crease_chain(mesh, e), std::vector<Edge>{e});
}

TEST(CreaseChain, AcceptsZeroLengthEdge) {
  Mesh mesh = built(grid(4)).mesh;
  mesh.set_position(at(4, 2, 2), mesh.position(at(4, 1, 2)));
  const Edge e = mesh.find_edge(at(4, 1, 2), at(4, 2, 2));
  EXPECT_GE(crease_chain(mesh, e).size(), 1U);
}

TEST(SharpnessDifference, EqualsDifferenceOfSettingEachEdge) {
  Mesh mesh = built(grid(6)).mesh;
  mesh.set_sharpness(mesh.find_edge(at(6, 2, 2), at(6, 3, 2)), 1.0F);
  mesh.set_sharpness(mesh.find_edge(at(6, 1, 1), at(6, 1, 2)), 7.0F);
  const std::vector<EdgeSharpness> wanted{
      {mesh.find_edge(at(6, 4, 4), at(6, 5, 4)), kInfinitelySharp},
      {mesh.find_edge(at(6, 1, 1), at(6, 1, 2)), 7.0F},  // unchanged
      {mesh.find_edge(at(6, 2, 2), at(6, 3, 2)), 0.0F},
      {mesh.find_edge(at(6, 0, 0), at(6, 1, 0)), 2.5F}};  // on the boundary
  Mesh expected = mesh;
  for (const EdgeSharpness& one : wanted)
    expected.set_sharpness(one.edge, one.sharpness);
  const MeshDelta delta = sharpness_difference(mesh, wanted);
  EXPECT_TRUE(delta.keeps_topology());
  EXPECT_FALSE(delta.is_empty());
  const Mesh before = mesh;
  mesh.changes().clear();
  apply(mesh, delta);
  EXPECT_TRUE(difference(mesh, expected).is_empty());
  expect_valid(mesh);
  std::uint32_t noted = 0;
  for (const ChangedRange range : mesh.changes().merged(GpuArray::edge_class))
    noted += range.end - range.begin;
  EXPECT_EQ(noted, 5U) << "two inner edges and one half-edge; unchanged edges are not logged";
  EXPECT_TRUE(mesh.changes().merged(GpuArray::position).empty());
  EXPECT_TRUE(mesh.changes().merged(GpuArray::origin).empty());
  revert(mesh, delta);
  EXPECT_TRUE(difference(mesh, before).is_empty());
  EXPECT_TRUE(sharpness_difference(mesh, {}).is_empty());
}

TEST(MeshDelta, OnlyACollapseChangesTheTopology) {
  const Mesh grid_mesh = built(grid(4)).mesh;
  EXPECT_FALSE(difference(grid_mesh, built(grid(3)).mesh).keeps_topology());
  EXPECT_TRUE(difference(grid_mesh, grid_mesh).keeps_topology());
}

}  // namespace
}  // namespace mesher::test
