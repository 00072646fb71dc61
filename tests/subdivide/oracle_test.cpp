// Tests of the oracles: they are compared with values computed by hand, and with OpenSubdiv and
// OpenMesh.
#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "tests/subdivide/butterfly_oracle.h"
#include "tests/subdivide/compare.h"
#include "tests/subdivide/derose98_oracle.h"
#include "tests/subdivide/hoppe94_oracle.h"
#include "tests/subdivide/models.h"
#include "tests/subdivide/openmesh_reference.h"
#include "tests/subdivide/opensubdiv_reference.h"
#include "tests/support/meshes.h"

namespace mesher::test {
namespace {

PlainMesh plain(Soup soup,
                subdivide::BoundaryRounding boundary = subdivide::BoundaryRounding::edge_only) {
  return plain_mesh(built(std::move(soup)).mesh, boundary);
}

void expect_at(const Point& p, const Point& wanted) {
  EXPECT_NEAR(p.x, wanted.x, 1e-12);
  EXPECT_NEAR(p.y, wanted.y, 1e-12);
  EXPECT_NEAR(p.z, wanted.z, 1e-12);
}

TEST(Oracle, MatchesOctahedronComputedByHand) {
  const PlainMesh fine = refine(plain(octahedron()), hoppe94_rules());
  ASSERT_EQ(fine.positions.size(), 18U);
  // Valence 4: the vertex has the weight 33/64, and the mean of the ring is the origin.
  expect_at(fine.positions[0], {33.0 / 64.0, 0, 0});
  // The edge 0-1 of face 0: opposite vertices are top and bottom.
  expect_at(fine.positions[6], {3.0 / 8.0, 3.0 / 8.0, 0});
  EXPECT_EQ(fine.triangles[0], (Triangle{0, 6, 8}));
  EXPECT_EQ(fine.triangles[1], (Triangle{6, 1, 7}));
  EXPECT_EQ(fine.triangles[2], (Triangle{8, 7, 4}));
  EXPECT_EQ(fine.triangles[3], (Triangle{6, 7, 8}));
  // w = 3 / (11 - 8 * 33/64)
  expect_at(limit_positions(plain(octahedron()), hoppe94_rules())[0],
            {3.0 / (11.0 - 8.0 * 33.0 / 64.0), 0, 0});
}

TEST(Oracle, MatchesTriangleComputedByHand) {
  const Soup one = soup_of({{0, 0, 0}, {8, 0, 0}, {0, 8, 0}}, {0, 1, 2});
  const PlainMesh round = refine(plain(one), hoppe94_rules());
  expect_at(round.positions[0], {1, 1, 0});
  expect_at(round.positions[3], {4, 0, 0});
  const PlainMesh cornered =
      refine(plain(one, subdivide::BoundaryRounding::edge_and_corner), hoppe94_rules());
  expect_at(cornered.positions[0], {0, 0, 0});
  expect_at(cornered.positions[4], {4, 4, 0});
}

TEST(Oracle, MatchesOpenFanComputedByHand) {
  // Three faces around vertex 0, a regular boundary vertex of valence 4. Its neighbors are not
  // regular.
  const Soup three = soup_of({{0, 0, 0}, {8, 0, 0}, {8, 8, 0}, {0, 8, 8}, {-8, 0, 0}},
                             {0, 1, 2, 0, 2, 3, 0, 3, 4});
  const PlainMesh hoppe = refine(plain(three), hoppe94_rules());
  expect_at(hoppe.positions[0], {0, 0, 0});
  expect_at(hoppe.positions[5], {3, 0, 0});  // 5/8 of the regular end
  expect_at(refine(plain(three), derose98_rules()).positions[5], {4, 0, 0});
  // The edge 0-2 is smooth: 3/8 of its ends, 1/8 of 1 and 3.
  expect_at(hoppe.positions[7], {4, 4, 1});
}

TEST(Oracle, MatchesDartsComputedByHand) {
  Mesh mesh = built(octahedron()).mesh;
  mesh.set_sharpness(mesh.find_edge(Vertex(0), Vertex(1)), kInfinitelySharp);
  const PlainMesh tagged = plain_mesh(mesh, subdivide::BoundaryRounding::edge_only);
  expect_at(refine(tagged, hoppe94_rules()).positions[6], {0.375, 0.375, 0});
  const PlainMesh fine = refine(tagged, derose98_rules());
  expect_at(fine.positions[6], {0.5, 0.5, 0});
  expect_at(fine.positions[0], {33.0 / 64.0, 0, 0});
  EXPECT_EQ(fine.sharpness.size(), 2U);
}

TEST(Oracle, MatchesSharpnessComputedByHand) {
  const std::vector<double> others{0.0, 2.0, kForEver, 4.0};
  EXPECT_EQ(child_sharpness(2.5, others, subdivide::CreaseDecay::uniform), 1.5);
  EXPECT_EQ(child_sharpness(2.5, others, subdivide::CreaseDecay::chaikin),
            0.75 * 2.5 + 0.25 * 3.0 - 1.0);
  EXPECT_EQ(child_sharpness(2.5, {}, subdivide::CreaseDecay::chaikin), 1.5);
  EXPECT_EQ(child_sharpness(0.5, {}, subdivide::CreaseDecay::uniform), 0.0);
  EXPECT_EQ(child_sharpness(0.0, others, subdivide::CreaseDecay::chaikin), 0.0);
  EXPECT_EQ(child_sharpness(kForEver, others, subdivide::CreaseDecay::chaikin), kForEver);
}

TEST(Oracle, SharpnessOneHalfBlendsBothRulesEqually) {
  Mesh mesh = built(octahedron()).mesh;
  for (std::uint32_t i = 0; i < 4; ++i)
    mesh.set_sharpness(mesh.find_edge(Vertex(i), Vertex((i + 1) % 4)), 0.5F);
  const PlainMesh fine =
      refine(plain_mesh(mesh, subdivide::BoundaryRounding::edge_only), derose98_rules());
  expect_at(fine.positions[0], {(0.75 + 33.0 / 64.0) / 2.0, 0, 0});
  expect_at(fine.positions[6], {(0.5 + 0.375) / 2.0, (0.5 + 0.375) / 2.0, 0});
  EXPECT_TRUE(fine.sharpness.empty());
}

TEST(Oracle, SubdivisionConvergesToTheLimits) {
  for (const OracleRules& rules :
       {hoppe94_rules(), derose98_rules(), hoppe94_rules(subdivide::CreaseDecay::chaikin)}) {
    for (const Model& model : models()) {
      if (model.mesh.face_count() > 24) continue;
      SCOPED_TRACE(model.name);
      const PlainMesh mesh = plain_mesh(model.mesh, subdivide::BoundaryRounding::edge_only);
      const std::vector<Point> limit = limit_positions(mesh, rules);
      PlainMesh fine = refine(mesh, rules);
      const std::vector<Point> later = limit_positions(fine, rules);
      EXPECT_LT(largest_distance(limit, std::span(later).first(limit.size())), 1e-12);
      const auto apart = [&] {
        return largest_distance(limit, std::span(fine.positions).first(limit.size()));
      };
      fine = refine(refine(fine, rules), rules);
      const double before = apart();
      fine = refine(fine, rules);
      if (is_settled(model.mesh)) {
        EXPECT_LE(apart(), 0.7 * before);
      }
    }
  }
}

TEST(Oracle, CreaseLimitsMatchTheKnownMasks) {
  // Boundary of a triangle: every vertex is non-regular. One level deeper the mask is 1/5, 3/5,
  // 1/5.
  const PlainMesh fine =
      refine(plain(soup_of({{0, 0, 0}, {8, 0, 0}, {0, 8, 0}}, {0, 1, 2})), hoppe94_rules());
  const std::vector<Point> limit = limit_positions(fine, hoppe94_rules());
  expect_at(limit[0], 0.6 * fine.positions[0] + 0.2 * (fine.positions[3] + fine.positions[5]));
  const std::vector<Point> spline = limit_positions(fine, derose98_rules());
  expect_at(spline[0], (4.0 * fine.positions[0] + fine.positions[3] + fine.positions[5]) / 6.0);
}

TEST(Oracle, OctahedronNormalsPointOutward) {
  const PlainMesh mesh = plain(octahedron());
  const std::vector<Point> normals = limit_normals(mesh, hoppe94_rules());
  ASSERT_EQ(normals.size(), 24U);
  for (std::size_t c = 0; c < normals.size(); ++c)
    expect_at(normals[c], mesh.positions[mesh.triangles[c / 3][c % 3]]);
}

TEST(Oracle, NormalsAreEqualOneLevelDeeper) {
  for (const OracleRules& rules : {hoppe94_rules(), derose98_rules()}) {
    for (const Model& model : models()) {
      if (model.mesh.face_count() > 40) continue;
      SCOPED_TRACE(model.name);
      const PlainMesh mesh = plain_mesh(model.mesh, subdivide::BoundaryRounding::edge_only);
      const std::vector<Point> coarse = limit_normals(mesh, rules);
      const std::vector<Point> fine = limit_normals(refine(mesh, rules), rules);
      double worst = 0.0;
      for (std::size_t c = 0; c < coarse.size(); ++c) {
        // The child at corner k of face f is face 4f + k, with the old vertex in corner k.
        const Point& later = fine[3 * (4 * (c / 3) + c % 3) + c % 3];
        if (coarse[c] != Point(0.0) && later != Point(0.0))
          worst = std::max(worst, glm::distance(coarse[c], later));
      }
      EXPECT_LT(worst, 1e-3);
    }
  }
}

TEST(Oracle, ButterflyKeepsAPlaneAndItsVertices) {
  const PlainMesh sheet = plain(grid(4));
  const PlainMesh fine = refine_butterfly(sheet);
  for (std::size_t v = 0; v < sheet.positions.size(); ++v)
    expect_at(fine.positions[v], sheet.positions[v]);
  for (const Point& p : fine.positions)
    EXPECT_EQ(p.z, 0.0);
  // Far inside, all vertices are regular, and butterfly reproduces linear functions.
  const Adjacency near = adjacency(sheet);
  const std::uint32_t edge = near.edge_index.at(pair_of(6, 12));
  expect_at(fine.positions[sheet.positions.size() + edge], {1.5, 1.5, 0});
}

}  // namespace
}  // namespace mesher::test
