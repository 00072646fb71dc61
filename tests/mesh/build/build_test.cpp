#include "engine/mesh/build/build.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "engine/core/error.h"
#include "engine/core/parallel.h"
#include "engine/mesh/statistics.h"
#include "tests/support/attributes.h"
#include "tests/support/meshes.h"
#include "tests/support/sanitized.h"

namespace mesher::test {
namespace {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

TEST(Build, CleanSoupKeepsItsOrder) {
  const Soup soup = cube();
  const BuildResult r = built(cube());
  EXPECT_TRUE(r.report.is_clean());
  ASSERT_EQ(r.mesh.halfedge_count(), soup.corners.size());
  for (std::uint32_t h = 0; h < r.mesh.halfedge_count(); ++h) {
    EXPECT_EQ(r.mesh.origin(Halfedge(h)).index(), soup.corners[h]);
  }
  for (std::uint32_t v = 0; v < r.mesh.vertex_count(); ++v) {
    EXPECT_EQ(r.mesh.position(Vertex(v)), soup.positions[v]);
    EXPECT_EQ(r.vertex_source[v], v);
  }
  const Statistics s = statistics(r.mesh);
  EXPECT_EQ(s.euler_characteristic, 2);
  EXPECT_EQ(s.boundary_edges, 0U);
}

TEST(Build, EmptySoupGivesEmptyMesh) {
  const BuildResult r = built({});
  EXPECT_EQ(r.mesh.face_count(), 0U);
  EXPECT_EQ(r.mesh.vertex_count(), 0U);
}

TEST(Build, DropsDegenerateFaces) {
  Soup soup = tetrahedron();
  for (const std::uint32_t v : {0U, 0U, 1U, 2U, 2U, 2U})
    soup.corners.push_back(v);
  const BuildResult r = built(std::move(soup));
  expect_report(r.report, {{Repair::degenerate_faces_dropped, 2}});
  EXPECT_EQ(r.mesh.face_count(), 4U);
}

TEST(Build, DropsDuplicateFacesOfOneOrientation) {
  Soup soup = tetrahedron();
  for (const std::uint32_t v : {2U, 1U, 0U, 0U, 2U, 1U, 1U, 3U, 0U})
    soup.corners.push_back(v);
  const BuildResult r = built(std::move(soup));
  expect_report(r.report, {{Repair::duplicate_faces_dropped, 3}});
  EXPECT_EQ(statistics(r.mesh).euler_characteristic, 2);
}

TEST(Build, DropsDuplicateOfSingleTriangle) {
  const BuildResult r = built(soup_of({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {0, 1, 2, 1, 2, 0}));
  expect_report(r.report, {{Repair::duplicate_faces_dropped, 1}});
  EXPECT_EQ(r.mesh.face_count(), 1U);
}

TEST(Build, DropsNonFiniteVerticesAndTheirFaces) {
  Soup soup = cube();
  soup.positions[6].y = kNan;
  const BuildResult r = built(std::move(soup));
  expect_report(r.report,
                {{Repair::non_finite_vertices_dropped, 1}, {Repair::non_finite_faces_dropped, 5}});
  EXPECT_EQ(r.mesh.vertex_count(), 7U);
  EXPECT_EQ(r.mesh.face_count(), 7U);
}

TEST(Build, DropsOrKeepsIsolatedVerticesOnRequest) {
  Soup soup = tetrahedron();
  soup.positions.insert(soup.positions.begin(), glm::vec3(9.0F));
  for (std::uint32_t& v : soup.corners)
    ++v;
  const BuildResult dropped = built(Soup(soup));
  expect_report(dropped.report, {{Repair::isolated_vertices_dropped, 1}});
  EXPECT_EQ(dropped.mesh.vertex_count(), 4U);
  EXPECT_EQ(dropped.vertex_source[0], 1U);
  const BuildResult kept = built(std::move(soup), {.keep_isolated_vertices = true});
  expect_report(kept.report, {{Repair::isolated_vertices_kept, 1}});
  EXPECT_EQ(kept.mesh.vertex_count(), 5U);
  EXPECT_TRUE(kept.mesh.is_isolated(Vertex(0)));
}

TEST(Build, FlipsTheMinorityOfFaces) {
  Soup soup = torus(12, 8);
  for (const std::uint32_t f : {3U, 17U, 18U, 100U}) {
    std::swap(soup.corners[3 * f + 1], soup.corners[3 * f + 2]);
  }
  const BuildResult r = built(std::move(soup));
  expect_report(r.report, {{Repair::faces_flipped, 4}});
  const Statistics s = statistics(r.mesh);
  EXPECT_EQ(s.euler_characteristic, 0);
  EXPECT_EQ(s.boundary_edges, 0U);
  EXPECT_GT(s.volume, 0.0);
}

TEST(Build, FlippedFaceKeepsItsCornerAttributes) {
  Soup soup = tetrahedron();
  for (std::uint32_t i = 0; i < 12; ++i)
    soup.attributes.texcoord.push_back({float(i), 0.0F});
  soup.attributes.normal.assign(12, glm::vec3(0, 0, 1));
  std::swap(soup.corners[4], soup.corners[5]);
  const BuildResult r = built(std::move(soup));
  expect_report(r.report, {{Repair::faces_flipped, 1}});
  EXPECT_EQ(test::corners_of(r).texcoord[4].x, 5.0F);
  EXPECT_EQ(test::corners_of(r).texcoord[5].x, 4.0F);
}

TEST(Build, FlippedFaceNegatesOnlyInwardNormals) {
  Soup wrong_winding = grid(2);
  wrong_winding.attributes.normal.assign(24, glm::vec3(0, 0, 1));  // already correct
  std::swap(wrong_winding.corners[4], wrong_winding.corners[5]);
  Soup turned_over = wrong_winding;
  for (std::size_t c = 3; c < 6; ++c)
    turned_over.attributes.normal[c] = glm::vec3(0, 0, -1);
  for (Soup* soup : {&wrong_winding, &turned_over}) {
    const BuildResult r = built(std::move(*soup));
    expect_report(r.report, {{Repair::faces_flipped, 1}});
    for (const glm::vec3& n : test::corners_of(r).normal)
      EXPECT_EQ(n, glm::vec3(0, 0, 1));
  }
}

Soup quads(Soup soup, std::initializer_list<std::uint32_t> corners) {
  soup.corners.assign(corners);
  soup.face_start.clear();
  for (std::uint32_t i = 0; i <= soup.corners.size(); i += 4)
    soup.face_start.push_back(i);
  return soup;
}

TEST(Build, QuadIsADuplicateInEveryCornerOrder) {
  for (const auto& second :
       {std::array<std::uint32_t, 4>{3, 0, 1, 2}, {1, 2, 3, 0}, {0, 1, 2, 3}}) {
    Soup soup = quads(grid(1), {0, 1, 3, 2, 0, 0, 0, 0});
    const std::array<std::uint32_t, 4> ring{0, 1, 3, 2};
    for (std::size_t i = 0; i < 4; ++i)
      soup.corners[4 + i] = ring[second[i]];
    const BuildResult r = built(std::move(soup));
    expect_report(r.report,
                  {{Repair::polygons_triangulated, 1}, {Repair::duplicate_faces_dropped, 1}});
    EXPECT_EQ(r.mesh.face_count(), 2U);
  }
}

TEST(Build, ClosedCubeWithDuplicateQuadStaysClosed) {
  const BuildResult r = built(quads(cube(), {0, 3, 2, 1, 4, 5, 6, 7, 0, 1, 5, 4, 1, 2,
                                             6, 5, 2, 3, 7, 6, 3, 0, 4, 7, 5, 6, 7, 4}));
  EXPECT_EQ(r.report[Repair::duplicate_faces_dropped], 1U);
  const Statistics s = statistics(r.mesh);
  EXPECT_TRUE(s.is_closed());
  EXPECT_EQ(s.components, 1U);
  EXPECT_NEAR(s.volume, 1.0, 1e-12);
}

// Two quads share three vertices, and no other face uses the middle one. If both were split along
// the same diagonal, they would leave a duplicate triangle.
TEST(Build, CleanQuadMeshStaysCleanForAnyDiagonals) {
  Soup soup = quads(soup_of({{0, 0, 0}, {1, -.1F, 0}, {2, 0, 0}, {1, 3, 0}, {1, -3, 0}}, {}),
                    {0, 1, 2, 3, 2, 1, 0, 4});
  soup.attributes.texcoord.clear();
  for (const std::uint32_t v : soup.corners)
    soup.attributes.texcoord.push_back({float(v), 0.0F});
  const BuildResult r = built(std::move(soup));
  expect_report(r.report, {{Repair::polygons_triangulated, 2}});
  EXPECT_EQ(r.mesh.face_count(), 4U);
  EXPECT_FALSE(r.mesh.is_boundary(Vertex(1)));
  const Array<glm::vec2> texcoord = test::corners_of(r).texcoord;
  for (std::uint32_t h = 0; h < r.mesh.halfedge_count(); ++h) {
    EXPECT_EQ(texcoord[h].x, float(r.mesh.origin(Halfedge(h)).index()));
  }
}

TEST(Build, PolygonsWithSameCornersInDifferentOrderAreKept) {
  const BuildResult r = built(quads(cube(), {0, 1, 2, 3, 0, 2, 1, 3}));
  EXPECT_EQ(r.report[Repair::polygons_triangulated], 2U);
}

TEST(Build, CutsMoebiusStripOpen) {
  const BuildResult r = built(moebius(16));
  EXPECT_EQ(r.report[Repair::unorientable_edges_cut], 1U);
  EXPECT_EQ(r.mesh.face_count(), 32U);
  const Statistics s = statistics(r.mesh);
  EXPECT_EQ(s.boundary_loops, 1U);
  EXPECT_EQ(s.components, 1U);
  EXPECT_EQ(s.euler_characteristic, 1);  // The strip is cut into a flat band, which is a disc.
}

TEST(Build, SplitsThreeFacesOnOneEdge) {
  const BuildResult r = built(soup_of({{0, 0, 0}, {0, 0, 1}, {1, 0, 0}, {-1, 1, 0}, {-1, -1, 0}},
                                      {0, 1, 2, 1, 0, 3, 0, 1, 4}));
  EXPECT_EQ(r.report[Repair::non_manifold_edges_cut], 1U);
  EXPECT_EQ(r.mesh.face_count(), 3U);
  EXPECT_EQ(statistics(r.mesh).components, 2U);
}

TEST(Build, CubesSharingAnEdgeStayClosed) {
  Soup soup = join(cube(), cube(), {1.0F, 1.0F, 0.0F});
  // The shared edge is x = y = 1/2: vertices 2 and 6 of the first cube are 0 and 4 of the second.
  for (std::uint32_t& v : soup.corners)
    v = v == 8 ? 2 : v == 12 ? 6 : v;
  const BuildResult r = built(std::move(soup));
  const Statistics s = statistics(r.mesh);
  EXPECT_EQ(r.report[Repair::non_manifold_edges_cut], 1U);
  EXPECT_EQ(r.report[Repair::non_manifold_vertices_cut], 2U);
  EXPECT_EQ(s.boundary_edges, 0U);
  EXPECT_EQ(s.components, 2U);
  EXPECT_EQ(s.euler_characteristic, 4);
  EXPECT_EQ(s.vertices, 16U);
  EXPECT_NEAR(s.volume, 2.0, 1e-9);
}

TEST(Build, SolidsSharingAChainOfEdgesStayClosed) {
  // Two boxes of 1 x 1 x 2, each a prism of two layers, touch along x = y = 1, z = 0..2.
  const auto prism = [](glm::vec3 at) {
    Soup s;
    for (int z = 0; z < 3; ++z) {
      for (const auto& [x, y] : {std::pair{0, 0}, {1, 0}, {1, 1}, {0, 1}}) {
        s.positions.push_back(at + glm::vec3(x, y, z));
      }
    }
    const auto quad = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) {
      for (const std::uint32_t v : {a, b, c, a, c, d})
        s.corners.push_back(v);
    };
    quad(3, 2, 1, 0);
    quad(8, 9, 10, 11);
    for (std::uint32_t z = 0; z < 2; ++z) {
      for (std::uint32_t k = 0; k < 4; ++k) {
        const std::uint32_t a = 4 * z + k;
        const std::uint32_t b = 4 * z + (k + 1) % 4;
        quad(a, b, b + 4, a + 4);
      }
    }
    return s;
  };
  Soup soup = join(prism({0, 0, 0}), prism({1, 1, 0}));
  for (std::uint32_t& v : soup.corners)
    v = v == 12 ? 2 : v == 16 ? 6 : v == 20 ? 10 : v;
  const BuildResult r = built(std::move(soup));
  const Statistics s = statistics(r.mesh);
  EXPECT_EQ(r.report[Repair::non_manifold_edges_cut], 2U);
  EXPECT_EQ(s.boundary_edges, 0U);
  EXPECT_EQ(s.components, 2U);
  EXPECT_NEAR(s.volume, 4.0, 1e-9);
}

TEST(Build, SplitsVertexBetweenTwoFans) {
  Soup soup = join(tetrahedron(), tetrahedron(), {1.0F, 0.0F, 0.0F});
  for (std::uint32_t& v : soup.corners)
    v = v == 4 ? 1 : v;
  const BuildResult r = built(std::move(soup));
  expect_report(r.report,
                {{Repair::non_manifold_vertices_cut, 1}, {Repair::isolated_vertices_dropped, 1}});
  EXPECT_EQ(statistics(r.mesh).components, 2U);
  EXPECT_EQ(r.vertex_source.back(), 1U);
}

TEST(Build, CreasesFollowTheirVerticesThroughRepairs) {
  Soup soup = join(cube(), cube(), {1.0F, 1.0F, 0.0F});
  for (std::uint32_t& v : soup.corners)
    v = v == 8 ? 2 : v == 12 ? 6 : v;
  soup.creases = {{2, 6, 3.0F}, {1, 0, kInfinitelySharp}, {0, 7, 1.0F}, {4, 6, kNan},
                  {0, 1, 2.0F}, {900, 1, 1.0F},           {5, 6, -1.0F}};
  const BuildResult r = built(std::move(soup));
  EXPECT_EQ(r.report[Repair::creases_on_missing_edges], 2U);
  EXPECT_EQ(r.report[Repair::invalid_sharpness_ignored], 2U);
  EXPECT_EQ(r.report[Repair::contradictory_creases], 1U);
  std::size_t threes = 0;
  std::size_t twos = 0;
  for (const float s : r.mesh.sharpnesses()) {
    threes += s == 3.0F ? 1 : 0;
    twos += s == 2.0F ? 1 : 0;
  }
  EXPECT_EQ(threes, 4U);  // the cut duplicates the shared edge
  EXPECT_EQ(twos, 2U);
}

TEST(Build, CornerTagsBecomeVertexSharpness) {
  Soup soup = tetrahedron();
  soup.corner_tags = {{2, 1.5F}, {77, 1.0F}, {1, kNan}};
  const BuildResult r = built(std::move(soup));
  EXPECT_EQ(r.mesh.sharpness(Vertex(2)), 1.5F);
  EXPECT_EQ(r.mesh.sharpness(Vertex(1)), 0.0F);
  EXPECT_EQ(r.report[Repair::invalid_sharpness_ignored], 1U);
}

TEST(Build, RejectsMalformedSoup) {
  EXPECT_THROW((void)build_mesh(soup_of({{0, 0, 0}}, {0, 0, 1})), InputError);
  EXPECT_THROW((void)build_mesh(soup_of({{0, 0, 0}}, {0, 0})), InputError);
  Soup gap = tetrahedron();
  gap.face_start.assign({0, 5, 4, 12});
  EXPECT_THROW((void)build_mesh(std::move(gap)), InputError);
  Soup attributes = tetrahedron();
  attributes.attributes.texcoord.resize(5);
  EXPECT_THROW((void)build_mesh(std::move(attributes)), InputError);
}

TEST(Build, StopsWhenCanceled) {
  Progress progress;
  progress.cancel();
  EXPECT_THROW((void)build_mesh(tetrahedron(), {.progress = &progress}), Cancelled);
}

TEST(Build, ManyFacesOnOneEdgeTakeLinearTime) {
  Soup soup;
  soup.positions = {{0, 0, 0}, {0, 0, 1}};
  for (std::uint32_t i = 0; i < 200'000; ++i) {
    soup.positions.push_back({std::cos(float(i)), std::sin(float(i)), 0.0F});
    for (const std::uint32_t v : {0U, 1U, i + 2})
      soup.corners.push_back(v);
  }
  const BuildResult r = built(std::move(soup));
  EXPECT_EQ(r.report[Repair::non_manifold_edges_cut], 1U);
  EXPECT_EQ(r.mesh.face_count(), 200'000U);
}

Soup random_sized_soup(std::uint32_t seed, std::uint32_t vertices, std::uint32_t faces) {
  std::mt19937 random(seed);
  Soup soup;
  for (std::uint32_t v = 0; v < vertices; ++v) {
    const auto coordinate = [&] { return static_cast<float>(random() % 1000) / 100.0F; };
    const float x = coordinate();
    const float y = coordinate();
    soup.positions.push_back({x, y, coordinate()});
  }
  for (std::uint32_t i = 0; i < 3 * faces; ++i) {
    soup.corners.push_back(static_cast<std::uint32_t>(random() % vertices));
  }
  return soup;
}

// Few vertices and many random faces give non-manifold edges, pinched vertices, unorientable parts
// and duplicates all at once.
TEST(Build, RandomSoupBecomesManifold) {
  for (std::uint32_t seed = 0; seed < 3000; ++seed) {
    const std::uint32_t vertices = 4 + seed % 13;
    const BuildResult r = built(random_sized_soup(seed, vertices, 1 + seed % 60));
    if (testing::Test::HasFailure()) FAIL() << "seed " << seed;
    const std::uint64_t dropped =
        r.report[Repair::duplicate_faces_dropped] + r.report[Repair::degenerate_faces_dropped];
    EXPECT_EQ(r.mesh.face_count() + dropped, 1 + seed % 60);
  }
}

TEST(Build, RandomPolygonSoupBecomesManifold) {
  for (std::uint32_t seed = 0; seed < 2000; ++seed) {
    Soup soup = random_sized_soup(seed, 4 + seed % 17, 1 + seed % 50);
    for (std::uint32_t at = 0, k = seed; at <= soup.corners.size(); at += 2 + k++ % 6) {
      soup.face_start.push_back(at);
    }
    soup.face_start.back() = static_cast<std::uint32_t>(soup.corners.size());
    if (soup.face_start.size() < 2) continue;
    (void)built(std::move(soup));
    if (testing::Test::HasFailure()) FAIL() << "seed " << seed;
  }
}

TEST(Build, SameBytesForAnyThreadCount) {
  const auto bytes_of = [](const BuildResult& r) {
    std::vector<std::uint32_t> bytes;
    for (const Vertex v : r.mesh.origins())
      bytes.push_back(v.index());
    for (const Halfedge h : r.mesh.twins())
      bytes.push_back(h.index());
    for (const Halfedge h : r.mesh.outgoings())
      bytes.push_back(h.index());
    return bytes;
  };
  constexpr std::uint32_t kSoup = kSanitized ? 20'000 : 60'000;
  std::vector<std::vector<std::uint32_t>> results;
  for (const unsigned threads : {1U, 2U, 5U}) {
    const ThreadLimit limit(threads);
    results.push_back(bytes_of(built(random_sized_soup(7, kSoup, kSoup / 2 * 3))));
    results.back().push_back(0);
    const auto more = bytes_of(built(torus(700, kSanitized ? 60 : 300)));
    results.back().insert(results.back().end(), more.begin(), more.end());
  }
  EXPECT_EQ(results[0], results[1]);
  EXPECT_EQ(results[0], results[2]);
}

}  // namespace
}  // namespace mesher::test
