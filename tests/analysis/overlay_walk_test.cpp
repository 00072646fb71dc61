#include "engine/analysis/overlay_walk.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <utility>

#include "engine/analysis/distance.h"
#include "engine/analysis/triangle_tree.h"
#include "tests/support/meshes.h"

namespace mesher::test {
namespace {

constexpr double kInfinite = std::numeric_limits<double>::infinity();

// A triangle over a grid of 4 by 4 squares.
const analysis::Triangle kInside{glm::dvec3(0.3, 0.4, 0.0), glm::dvec3(3.6, 0.7, 0.0),
                                 glm::dvec3(1.1, 3.5, 0.0)};

Mesh raised_grid(float height) {
  Soup soup = grid(4);
  for (glm::vec3& p : soup.positions)
    p.z = height;
  return built(std::move(soup)).mesh;
}

double bound(analysis::OverlayWalk& walk, const analysis::Triangle& t, Face hint,
             double shrink = 0.0) {
  return walk.locate(t, hint, shrink) < kInfinite ? walk.bound(kInfinite) : kInfinite;
}

TEST(OverlayWalk, FindsHeightOfParallelSheetFromAnyHint) {
  const Mesh sheet = raised_grid(0.25F);
  analysis::OverlayWalk walk(sheet);
  for (std::uint32_t f = 0; f < sheet.face_count(); ++f) {
    EXPECT_NEAR(walk.locate(kInside, Face(f), 0.0), 0.25, 1e-9);
    EXPECT_NEAR(walk.bound(1.0), 0.25, 1e-9);
  }
}

TEST(OverlayWalk, FindsSpikeBetweenTheCorners) {
  Soup soup = grid(4);
  soup.positions[12].z = 0.5F;  // the middle vertex
  const Mesh sheet = built(std::move(soup)).mesh;
  analysis::OverlayWalk walk(sheet);
  EXPECT_NEAR(bound(walk, kInside, Face(0)), 0.5, 1e-9);
}

TEST(OverlayWalk, GivesUpAboveTheUpperLimit) {
  const Mesh sheet = raised_grid(0.25F);
  analysis::OverlayWalk walk(sheet);
  ASSERT_LT(walk.locate(kInside, Face(0), 0.0), kInfinite);
  EXPECT_EQ(walk.bound(0.2), kInfinite);
}

TEST(OverlayWalk, FailsWhenTheTriangleExtendsBeyondTheSurface) {
  const Mesh sheet = raised_grid(0.0F);
  analysis::OverlayWalk walk(sheet);
  analysis::Triangle t = kInside;
  t[1].x = 4.1;
  EXPECT_EQ(bound(walk, t, Face(0)), kInfinite);
  // The walk succeeds if the part outside is cut off.
  EXPECT_LT(bound(walk, t, Face(0), 0.1), 1e-9);
}

TEST(OverlayWalk, FailsWhereTheSurfaceFoldsOver) {
  Soup soup = grid(4);
  soup.positions[12] = {3.5F, 2.0F, 0.1F};  // the middle vertex, moved past its neighbor
  const Mesh sheet = built(std::move(soup)).mesh;
  analysis::OverlayWalk walk(sheet);
  EXPECT_EQ(bound(walk, kInside, Face(0)), kInfinite);
}

TEST(OverlayWalk, FailsForZeroAreaTriangle) {
  const Mesh sheet = raised_grid(0.0F);
  analysis::OverlayWalk walk(sheet);
  EXPECT_EQ(walk.locate({kInside[0], kInside[1], kInside[1]}, Face(0), 0.0), kInfinite);
}

// The triangle may touch a wall that is perpendicular to it.
TEST(OverlayWalk, IgnoresFacesThatTheShrunkenTriangleDoesNotTouch) {
  const Mesh box = built(cube()).mesh;
  analysis::OverlayWalk walk(box);
  const analysis::TriangleTree tree(box);
  for (std::uint32_t f = 0; f < box.face_count(); ++f) {
    const analysis::Triangle side = tree.triangle(Face(f));
    EXPECT_LT(bound(walk, side, Face(f), 1e-3), 1e-9) << f;
  }
}

TEST(OverlayWalk, BoundsAreNeverBelowSampledDistances) {
  const Mesh fine = built(torus(60, 30)).mesh;
  const Mesh coarse = built(torus(23, 11)).mesh;
  for (const auto& [from, to] : {std::pair(&fine, &coarse), std::pair(&coarse, &fine)}) {
    analysis::OverlayWalk walk(*to);
    const analysis::TriangleTree tree(*to);
    const analysis::TriangleTree own(*from);
    int found = 0;
    for (std::uint32_t f = 0; f < from->face_count(); ++f) {
      const analysis::Triangle t = own.triangle(Face(f));
      const glm::dvec3 middle = (t[0] + t[1] + t[2]) / 3.0;
      const double upper = bound(walk, t, tree.nearest(middle).face);
      if (upper == kInfinite) continue;
      ++found;
      for (int i = 0; i <= 8; ++i) {
        for (int k = 0; k <= 8 - i; ++k) {
          const glm::dvec3 p = t[0] + 0.125 * i * (t[1] - t[0]) + 0.125 * k * (t[2] - t[0]);
          ASSERT_LE(std::sqrt(tree.nearest(p).squared_distance), upper + 1e-12);
        }
      }
    }
    EXPECT_GT(found, static_cast<int>(from->face_count()) / 2);
  }
}

}  // namespace
}  // namespace mesher::test
