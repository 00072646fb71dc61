#include "engine/analysis/distance.h"

#include <gtest/gtest.h>

#include <cmath>

#include "engine/core/error.h"
#include "engine/core/parallel.h"
#include "tests/support/meshes.h"

namespace mesher::test {
namespace {

Soup moved(Soup soup, const glm::vec3& by, float scale = 1.0F) {
  for (glm::vec3& p : soup.positions)
    p = p * scale + by;
  return soup;
}

TEST(SurfaceDistance, DistanceToItselfIsZero) {
  const Mesh mesh = built(torus(20, 12)).mesh;
  const analysis::SurfaceDistance d = analysis::surface_distance(mesh, mesh, {.samples = 20'000});
  EXPECT_LT(d.two_sided().max, 1e-7);
}

TEST(SurfaceDistance, DistanceOfParallelSheetsIsTheirGap) {
  const Mesh a = built(grid(4)).mesh;
  const Mesh b = built(moved(grid(4), {0, 0, 0.25F})).mesh;
  const analysis::SurfaceDistance d = analysis::surface_distance(a, b, {.samples = 5'000});
  for (const analysis::OneSidedDistance& side : {d.forward, d.backward, d.two_sided()}) {
    EXPECT_DOUBLE_EQ(side.rms, 0.25);
    EXPECT_DOUBLE_EQ(side.mean, 0.25);
    EXPECT_DOUBLE_EQ(side.max, 0.25);
  }
  EXPECT_DOUBLE_EQ(d.percent(d.two_sided().rms), 100.0 * 0.25 / std::sqrt(32.0));
}

// A tilted sheet over a flat one. The gap grows from 0 to 1, so mean and RMS are known.
TEST(SurfaceDistance, MeanAndRmsAreWeightedByArea) {
  Soup tilted = soup_of({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, {0, 1, 2, 0, 2, 3});
  // The sheet below is so large that the nearest point is straight below.
  const Mesh below = built(moved(grid(1), {-50, -50, 0}, 100.0F)).mesh;
  tilted.positions[1].z = tilted.positions[2].z = 1.0F;
  const Mesh above = built(std::move(tilted)).mesh;
  const analysis::SurfaceDistance d =
      analysis::surface_distance(above, below, {.samples = 100'000});
  EXPECT_NEAR(d.forward.mean, 0.5, 1e-3);
  EXPECT_NEAR(d.forward.rms, std::sqrt(1.0 / 3.0), 1e-3);
  EXPECT_DOUBLE_EQ(d.forward.max,
                   1.0);  // The maximum is at a vertex. No random sample need hit it.
}

TEST(SurfaceDistance, DirectionsDifferWhereOneSurfaceHasMore) {
  const Mesh part = built(grid(2)).mesh;
  const Mesh whole = built(join(grid(2), moved(grid(2), {10, 0, 0}))).mesh;
  const analysis::SurfaceDistance d = analysis::surface_distance(part, whole, {.samples = 10'000});
  EXPECT_LT(d.forward.max, 1e-12);
  EXPECT_DOUBLE_EQ(d.backward.max, 10.0);
  EXPECT_DOUBLE_EQ(d.two_sided().max, 10.0);
  const analysis::SurfaceDistance turned =
      analysis::surface_distance(whole, part, {.samples = 10'000});
  EXPECT_EQ(turned.forward.rms, d.backward.rms);
}

TEST(SurfaceDistance, SameForAnyThreadCount) {
  const Mesh a = built(torus(60, 40)).mesh;
  const Mesh b = built(moved(torus(50, 30), {0.01F, 0.02F, 0.0F})).mesh;
  std::vector<double> rms;
  for (const unsigned threads : {1U, 2U, 4U}) {
    const ThreadLimit limit(threads);
    rms.push_back(analysis::surface_distance(a, b, {.samples = 50'000}).forward.rms);
  }
  EXPECT_EQ(rms[0], rms[1]);
  EXPECT_EQ(rms[0], rms[2]);
  EXPECT_GT(rms[0], 0.0);
}

TEST(SurfaceDistance, ScalesWithTheModelsAndAcceptsZeroArea) {
  const Mesh a = built(torus(20, 12)).mesh;
  const Mesh b = built(torus(15, 9)).mesh;
  const double whole = analysis::surface_distance(a, b, {.samples = 20'000}).two_sided().rms;
  constexpr float kSmall = 0x1p-20F;  // a power of two, so the digits are equal
  const Mesh small_a = built(moved(torus(20, 12), glm::vec3(0.0F), kSmall)).mesh;
  const Mesh small_b = built(moved(torus(15, 9), glm::vec3(0.0F), kSmall)).mesh;
  EXPECT_EQ(analysis::surface_distance(small_a, small_b, {.samples = 20'000}).two_sided().rms,
            whole * kSmall);
  const Mesh line = built(soup_of({{0, 0, 0}, {1, 0, 0}, {3, 0, 0}}, {0, 1, 2})).mesh;
  const analysis::SurfaceDistance d = analysis::surface_distance(line, line, {.samples = 100});
  EXPECT_EQ(d.two_sided().max, 0.0);  // without area only the vertices are sampled
}

TEST(SurfaceDistance, StopsWhenCanceled) {
  const Mesh mesh = built(cube()).mesh;
  Progress progress;
  progress.cancel();
  EXPECT_THROW((void)analysis::surface_distance(mesh, mesh, {.progress = &progress}), Cancelled);
}

}  // namespace
}  // namespace mesher::test
