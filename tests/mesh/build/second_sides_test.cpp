#include "engine/mesh/build/second_sides.h"

#include <gtest/gtest.h>

#include "engine/mesh/build/build.h"
#include "engine/mesh/statistics.h"
#include "tests/support/attributes.h"
#include "tests/support/meshes.h"

namespace mesher::test {
namespace {

/// The faces of a soup, and after them the same faces turned around.
Soup two_sided(Soup soup) {
  const std::size_t corners = soup.corners.size();
  for (std::size_t c = 0; c < corners; c += 3) {
    for (const std::size_t i : {0U, 2U, 1U})
      soup.corners.push_back(std::uint32_t(soup.corners[c + i]));
  }
  return soup;
}

/// Two quads side by side, and the same on the other side.
Soup two_sided_quads() {
  Soup soup = soup_of({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {0, 1, 0}, {1, 1, 0}, {2, 1, 0}},
                      {0, 1, 4, 3, 1, 2, 5, 4, 3, 4, 1, 0, 4, 5, 2, 1});
  soup.face_start.assign({0, 4, 8, 12, 16});
  return soup;
}

// A half-edge mesh cannot hold both sides on the same vertices, so each becomes a sheet.
TEST(SecondSides, TwoSidedSurfaceBecomesTwoSheets) {
  const BuildResult r = built(two_sided(grid(3)));
  expect_report(r.report, {{Repair::second_sides_kept, 18}});
  const Statistics s = statistics(r.mesh);
  EXPECT_EQ(s.faces, 36U);
  EXPECT_EQ(s.components, 2U);
  EXPECT_EQ(s.vertices, 32U);
  EXPECT_EQ(s.boundary_edges, 24U);
  for (std::uint32_t v = 16; v < 32; ++v) {
    EXPECT_EQ(r.mesh.position(Vertex(v)), r.mesh.position(Vertex(r.vertex_source[v])));
  }
}

TEST(SecondSides, ClosedSurfaceTurnedInsideOutIsKept) {
  const BuildResult r = built(two_sided(cube()));
  const Statistics s = statistics(r.mesh);
  EXPECT_EQ(s.components, 2U);
  EXPECT_TRUE(s.is_closed());
  EXPECT_NEAR(s.volume, 0.0, 1e-12);
}

TEST(SecondSides, PolygonsAreSeparatedBeforeTheyAreCut) {
  const BuildResult r = built(two_sided_quads());
  expect_report(r.report, {{Repair::polygons_triangulated, 4}, {Repair::second_sides_kept, 2}});
  const Statistics s = statistics(r.mesh);
  EXPECT_EQ(s.components, 2U);
  EXPECT_EQ(s.vertices, 12U);
  EXPECT_EQ(s.boundary_edges, 12U);
}

TEST(SecondSides, PolygonsAndTrianglesShareASheet) {
  Soup soup = soup_of({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {0, 1, 0}, {1, 1, 0}},
                      {0, 1, 4, 3, 1, 2, 4, 3, 4, 1, 0, 4, 2, 1});
  soup.face_start.assign({0, 4, 7, 11, 14});
  const Statistics s = statistics(built(std::move(soup)).mesh);
  EXPECT_EQ(s.components, 2U);
  EXPECT_EQ(s.vertices, 10U);
}

TEST(SecondSides, AnotherGroupOnTheSameSideIsKept) {
  Soup soup = soup_of({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {0, 1, 2, 0, 1, 2, 1, 2, 0, 2, 1, 0});
  soup.attributes.group.assign({0, 1, 0, 1});
  soup.attributes.groups = test::named_groups({"brick", "paper"});
  const BuildResult r = built(std::move(soup));
  expect_report(r.report, {{Repair::second_sides_kept, 2}, {Repair::duplicate_faces_dropped, 1}});
  EXPECT_EQ(statistics(r.mesh).components, 3U);
  EXPECT_EQ(std::vector<std::uint32_t>(r.attributes.group.begin(), r.attributes.group.end()),
            (std::vector<std::uint32_t>{0, 1, 1}));
}

TEST(SecondSides, OneTwoSidedWallLeavesTheRestClosed) {
  Soup soup = cube();
  for (const std::uint32_t v : {0U, 1U, 2U, 3U, 0U, 2U})
    soup.corners.push_back(v);
  const BuildResult r = built(std::move(soup));
  expect_report(r.report, {{Repair::second_sides_kept, 2}});
  EXPECT_EQ(statistics(r.mesh).components, 2U);
  EXPECT_EQ(statistics(r.mesh).boundary_edges, 4U) << "of the wall's second side";
  EXPECT_EQ(r.mesh.vertex_count(), 12U);
}

// Creases belong to edges of the file, which both sides have.
TEST(SecondSides, CreasesAreOnBothSides) {
  Soup soup = two_sided(grid(1));
  soup.creases.push_back({0, 3, 2.0F});
  EXPECT_EQ(statistics(built(std::move(soup)).mesh).crease_edges, 2U);
  Soup quads = two_sided_quads();
  quads.creases.push_back({1, 4, 2.0F});
  EXPECT_EQ(statistics(built(std::move(quads)).mesh).crease_edges, 2U);
}

TEST(SecondSides, SortsFacesByDirectionAndGroup) {
  const std::vector<CoincidentFace> faces = {{3, false, 0}, {5, true, 0}, {6, false, 0},
                                             {8, false, 1}, {9, true, 0}, {10, true, 1}};
  CoincidentFaces sorted;
  sort_coincident(faces, sorted);
  EXPECT_EQ(sorted.duplicates, (std::vector<std::uint32_t>{6, 9}));
  ASSERT_EQ(sorted.second_sides.size(), 3U);
  for (std::uint32_t i = 0; i < 3; ++i)
    EXPECT_EQ(sorted.second_sides[i].sheet, i + 1);
}

}  // namespace
}  // namespace mesher::test
