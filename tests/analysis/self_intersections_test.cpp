#include "engine/analysis/self_intersections.h"

#include <gtest/gtest.h>

#include <random>

#include "engine/analysis/triangle_pair.h"
#include "engine/core/parallel.h"
#include "tests/support/meshes.h"

namespace mesher::test {
namespace {

std::vector<analysis::FacePair> by_brute_force(const Mesh& mesh) {
  std::vector<analysis::FacePair> pairs;
  for (std::uint32_t f = 0; f < mesh.face_count(); ++f) {
    if (analysis::is_degenerate(analysis::exact_triangle(mesh, Face(f)))) continue;
    for (std::uint32_t g = f + 1; g < mesh.face_count(); ++g) {
      if (analysis::is_degenerate(analysis::exact_triangle(mesh, Face(g)))) continue;
      if (analysis::do_intersect(analysis::exact_triangle(mesh, Face(f)),
                                 analysis::exact_triangle(mesh, Face(g))))
        pairs.push_back({Face(f), Face(g)});
    }
  }
  return pairs;
}

std::uint64_t count(Soup soup) {
  return analysis::count_self_intersections(built(std::move(soup)).mesh);
}

/// Triangles of the given size, anywhere in the unit cube.
Soup scattered(std::uint32_t faces, float size, std::uint32_t seed) {
  std::mt19937 random(seed);
  const auto number = [&] { return static_cast<float>(random() % 1'000'003U) / 1'000'003.0F; };
  Soup soup;
  for (std::uint32_t i = 0; i < faces; ++i) {
    const glm::vec3 middle(number(), number(), number());
    for (std::uint32_t c = 0; c < 3; ++c) {
      soup.corners.push_back(static_cast<std::uint32_t>(soup.positions.size()));
      soup.positions.push_back(middle + size * glm::vec3(number(), number(), number()));
    }
  }
  return soup;
}

TEST(SelfIntersections, CleanMeshesHaveNone) {
  EXPECT_EQ(analysis::count_self_intersections(Mesh()), 0U);
  EXPECT_EQ(count(tetrahedron()), 0U);
  EXPECT_EQ(count(cube()), 0U);
  EXPECT_EQ(count(grid(20)), 0U);
  EXPECT_EQ(count(torus(31, 17)), 0U);
  EXPECT_EQ(count(moebius(20)), 0U);
}

TEST(SelfIntersections, FindsPairsOfTwoPiercingTetrahedra) {
  const Mesh mesh = built(join(tetrahedron(), tetrahedron(), {0.1F, 0.1F, 0.1F})).mesh;
  const auto pairs = analysis::self_intersections(mesh);
  EXPECT_EQ(pairs, by_brute_force(mesh));
  EXPECT_FALSE(pairs.empty());
  for (const auto& [a, b] : pairs) {
    EXPECT_LT(a.index(), 4U);
    EXPECT_GE(b.index(), 4U);
  }
}

TEST(SelfIntersections, CopiesOfACutVertexDoNotIntersect) {
  // Two tetrahedra meet at a corner. The non-manifold vertex is cut into two copies.
  Soup soup = join(tetrahedron(), tetrahedron());
  for (std::size_t i = 4; i < 8; ++i)
    soup.positions[i] = -soup.positions[i];
  for (std::size_t i = 12; i < 24; i += 3)
    std::swap(soup.corners[i + 1], soup.corners[i + 2]);
  EXPECT_EQ(count(soup), 0U);
}

TEST(SelfIntersections, SheetsWithTheSameCornersOverlap) {
  EXPECT_EQ(count(join(grid(1), grid(1))), 2U);
}

TEST(SelfIntersections, ZeroAreaFacesAreIgnored) {
  Soup soup = soup_of({{0, 0, 0},
                       {2, 0, 0},
                       {1, 0, 0},
                       {1, 1, 0},
                       {1, 0, -1},
                       {1, 0, 1},
                       {9, 0.25F, -1},
                       {9, 0.25F, 1}},
                      {0, 2, 1});
  EXPECT_EQ(count(soup), 0U);
  // It lies in the plane y = 0 of this face. With an area it would touch.
  for (const std::uint32_t v : {4U, 5U, 6U})
    soup.corners.push_back(v);
  EXPECT_EQ(count(soup), 0U);
}

TEST(SelfIntersections, AgreeWithBruteForceOnScatteredTriangles) {
  for (const float size : {0.1F, 0.3F, 1.0F}) {
    const Mesh mesh = built(scattered(700, size, 5)).mesh;
    const auto pairs = analysis::self_intersections(mesh);
    EXPECT_EQ(pairs, by_brute_force(mesh)) << size;
    EXPECT_EQ(analysis::count_self_intersections(mesh), pairs.size());
    EXPECT_GT(pairs.size(), 10U);
  }
}

TEST(SelfIntersections, AgreeWithBruteForceOnRandomSoups) {
  for (std::uint32_t seed = 0; seed < 500; ++seed) {
    const Mesh mesh = built(random_soup(seed)).mesh;
    ASSERT_EQ(analysis::self_intersections(mesh), by_brute_force(mesh)) << seed;
  }
}

TEST(SelfIntersections, AgreeWithBruteForceOnCrumpledGrids) {
  for (const float size : {0.02F, 0.2F, 1.0F, 5.0F}) {
    for (std::uint32_t seed = 0; seed < 8; ++seed) {
      Soup soup = grid(12);
      std::mt19937 random(seed);
      for (glm::vec3& p : soup.positions) {
        for (int axis = 0; axis < 3; ++axis)
          p[axis] += size * (static_cast<float>(random() % 1001U) / 1000.0F - 0.5F);
      }
      const Mesh mesh = built(std::move(soup)).mesh;
      const auto pairs = analysis::self_intersections(mesh);
      ASSERT_EQ(pairs, by_brute_force(mesh)) << size << ' ' << seed;
      if (size < 0.1F) {
        EXPECT_TRUE(pairs.empty()) << seed;
      } else if (size > 4.0F) {
        EXPECT_FALSE(pairs.empty()) << size << ' ' << seed;
      }
    }
  }
}

TEST(SelfIntersections, SameForAnyThreadCount) {
  const Mesh mesh = built(scattered(20'000, 0.05F, 6)).mesh;
  const auto pairs = analysis::self_intersections(mesh);
  EXPECT_GT(pairs.size(), 1'000U);
  for (const unsigned threads : {1U, 2U, 5U}) {
    const ThreadLimit limit(threads);
    EXPECT_EQ(analysis::self_intersections(mesh), pairs);
    EXPECT_EQ(analysis::count_self_intersections(mesh), pairs.size());
  }
}

TEST(SelfIntersections, WorkAtTheEndsOfTheFloatRange) {
  for (const float scale : {0x1p-140F, 0x1p126F}) {
    Soup soup = join(torus(12, 8), torus(12, 8), {1.0F, 0.5F, 0.25F});
    const std::uint64_t expected = count(soup);
    EXPECT_GT(expected, 0U);
    // Rounded to multiples of 1/128, so that scaling loses no bit.
    for (glm::vec3& p : soup.positions)
      p = glm::round(p * 128.0F) / 128.0F;
    const std::uint64_t rounded = count(soup);
    for (glm::vec3& p : soup.positions)
      p *= scale;
    EXPECT_EQ(count(soup), rounded) << scale;
  }
}

TEST(SelfIntersections, StopWhenCanceled) {
  Progress progress;
  progress.cancel();
  const Mesh mesh = built(grid(60)).mesh;
  EXPECT_THROW(static_cast<void>(analysis::count_self_intersections(mesh, &progress)),
               std::exception);
}

}  // namespace
}  // namespace mesher::test
