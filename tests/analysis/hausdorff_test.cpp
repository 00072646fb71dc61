#include "engine/analysis/hausdorff.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include "engine/analysis/distance.h"
#include "engine/core/error.h"
#include "engine/core/parallel.h"
#include "tests/support/meshes.h"
#include "tests/support/sanitized.h"

namespace mesher::test {
namespace {

Soup placed(Soup soup, const glm::vec3& by, float scale = 1.0F) {
  for (glm::vec3& p : soup.positions)
    p = p * scale + by;
  return soup;
}

/// Checks that neither bound contradicts the samples and that the bounds are within the given
/// ratio.
void expect_bounds(const Mesh& a, const Mesh& b, double ratio) {
  const analysis::HausdorffBounds bounds = analysis::hausdorff_bounds(a, b, {.ratio = ratio});
  const analysis::SurfaceDistance sampled = analysis::surface_distance(a, b, {.samples = 20'000});
  EXPECT_GE(bounds.forward.upper, sampled.forward.max);
  EXPECT_GE(bounds.backward.upper, sampled.backward.max);
  const auto [lower, upper] = bounds.two_sided();
  EXPECT_LE(lower, upper);
  EXPECT_GE(lower, 0.5 * sampled.two_sided().max);
  // For surfaces that coincide, only rounding limits the bound.
  const double diagonal = bounding_box(a).diagonal() + bounding_box(b).diagonal();
  EXPECT_LE(upper, ratio * lower * (1.0 + 1e-9) + 1e-12 * diagonal);
}

TEST(HausdorffBounds, BoundGapOfParallelSheets) {
  const Mesh a = built(grid(4)).mesh;
  const Mesh b = built(placed(grid(3), {0, 0, 0.25F}, 4.0F / 3.0F)).mesh;
  const analysis::DistanceInterval gap = analysis::hausdorff_bounds(a, b).two_sided();
  EXPECT_NEAR(gap.lower, 0.25, 1e-6);
  EXPECT_GE(gap.upper, gap.lower);
  EXPECT_LE(gap.upper, 1.1 * 0.25 + 1e-6);
}

TEST(HausdorffBounds, FindSpikeOnOneSurface) {
  Soup spiked = grid(8);
  spiked.positions[40].z = 3.0F;  // the middle vertex
  const analysis::HausdorffBounds bounds = analysis::hausdorff_bounds(
      built(std::move(spiked)).mesh, built(grid(8)).mesh, {.ratio = 1.01});
  EXPECT_DOUBLE_EQ(bounds.forward.lower, 3.0);
  EXPECT_LE(bounds.forward.upper, 3.0 * 1.01);
  EXPECT_LT(bounds.backward.lower, 1.5);  // the middle of the sheet is near the flanks of the spike
}

TEST(HausdorffBounds, MissingPartCountsInOneDirection) {
  const Mesh part = built(grid(2)).mesh;
  const Mesh whole = built(join(grid(2), placed(grid(2), {10, 0, 0}))).mesh;
  const analysis::HausdorffBounds bounds = analysis::hausdorff_bounds(part, whole, {.ratio = 1.05});
  EXPECT_EQ(bounds.forward.lower, 0.0);
  EXPECT_DOUBLE_EQ(bounds.backward.lower, 10.0);
  EXPECT_LE(bounds.backward.upper, 10.5);
}

// All corners of the flat side lie on the other surface. Only points inside its faces show the
// distance.
TEST(HausdorffBounds, FindBumpBetweenTheCorners) {
  Soup bump = grid(2);
  bump.positions[4].z = 1.0F;
  const Soup flat = soup_of({{0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}}, {0, 1, 2, 0, 2, 3});
  const Mesh a = built(Soup(flat)).mesh;
  const Mesh b = built(std::move(bump)).mesh;
  const analysis::HausdorffBounds bounds = analysis::hausdorff_bounds(a, b, {.ratio = 1.01});
  EXPECT_DOUBLE_EQ(bounds.backward.lower, 1.0);
  const analysis::HausdorffBounds swapped = analysis::hausdorff_bounds(b, a, {.ratio = 1.01});
  EXPECT_EQ(swapped.forward.upper, bounds.backward.upper);
  // The middle of the flat side is nearest to the flank of the bump, which has a slope of 45
  // degrees.
  EXPECT_GE(bounds.forward.upper, std::sqrt(0.5) * (1.0 - 1e-9));
}

TEST(HausdorffBounds, HoldForRandomSoups) {
  for (std::uint32_t seed = 0; seed < (kSanitized ? 20U : 60U); ++seed) {
    SCOPED_TRACE(seed);
    const Mesh a = built(random_soup(seed)).mesh;
    const Mesh b = built(random_soup(seed + 1000)).mesh;
    if (a.face_count() == 0 || b.face_count() == 0) continue;
    for (const double ratio : {1.01, 1.1, 3.0})
      expect_bounds(a, b, ratio);
  }
}

TEST(HausdorffBounds, HoldForSurfacesOfDifferentResolution) {
  const Mesh fine = built(torus(90, 45)).mesh;
  for (const std::uint32_t n : {5U, 12U, 40U, 89U}) {
    SCOPED_TRACE(n);
    const Mesh coarse = built(torus(n, n / 2 + 1)).mesh;
    for (const double ratio : {1.01, 1.1, 3.0})
      expect_bounds(fine, coarse, ratio);
  }
}

TEST(HausdorffBounds, HoldFarFromTheOrigin) {
  const auto far = [](Soup soup) { return placed(std::move(soup), {1e6F, -1e6F, 1e6F}, 8.0F); };
  expect_bounds(built(far(torus(30, 20))).mesh, built(far(torus(20, 10))).mesh, 1.1);
}

TEST(HausdorffBounds, HoldForZeroAreaTriangles) {
  const Mesh line = built(soup_of({{0, 0, 0}, {1, 0, 0}, {3, 0, 0}}, {0, 1, 2})).mesh;
  const Mesh other = built(soup_of({{0, 2, 0}, {1, 2, 0}, {3, 2, 0}}, {0, 1, 2})).mesh;
  EXPECT_EQ(analysis::hausdorff_bounds(line, line).two_sided().upper, 0.0);
  const analysis::DistanceInterval apart =
      analysis::hausdorff_bounds(line, other, {.ratio = 1.01}).two_sided();
  EXPECT_DOUBLE_EQ(apart.lower, 2.0);
  EXPECT_LE(apart.upper, 2.02);
  expect_bounds(line, built(torus(10, 6)).mesh, 1.1);
}

TEST(HausdorffBounds, AreZeroForTheSameMesh) {
  const Mesh mesh = built(torus(20, 12)).mesh;
  EXPECT_EQ(analysis::hausdorff_bounds(mesh, mesh).two_sided().upper, 0.0);
}

// The distance is zero, so no ratio can be reached. The work limit ends the search.
TEST(HausdorffBounds, TerminateForCoincidingSurfacesWithDifferentTriangles) {
  const Mesh a = built(placed(grid(7), {0.1F, 0.2F, 0.0F}, 1.0F / 7.0F)).mesh;
  const Mesh b = built(placed(grid(1), {0.1F, 0.2F, 0.0F})).mesh;
  const analysis::DistanceInterval both =
      analysis::hausdorff_bounds(a, b, {.most_queries = 200'000}).two_sided();
  EXPECT_LE(both.lower, 1e-6);
  EXPECT_LE(both.upper, 0.2);
}

TEST(HausdorffBounds, IgnoreIsolatedVertices) {
  Soup soup = cube();
  soup.positions.push_back({1e9F, 0, 0});
  const Mesh with = built(std::move(soup)).mesh;
  EXPECT_EQ(analysis::hausdorff_bounds(with, built(cube()).mesh).two_sided().upper, 0.0);
}

TEST(HausdorffBounds, SameForAnyThreadCount) {
  const Mesh a = built(torus(120, 60)).mesh;
  const Mesh b = built(placed(torus(31, 20), {0.01F, 0.02F, 0.0F})).mesh;
  std::vector<analysis::HausdorffBounds> all;
  for (const unsigned threads : {1U, 2U, 4U}) {
    const ThreadLimit limit(threads);
    all.push_back(analysis::hausdorff_bounds(a, b, {.ratio = 1.02}));
  }
  for (const analysis::HausdorffBounds& bounds : all) {
    EXPECT_EQ(bounds.forward.lower, all[0].forward.lower);
    EXPECT_EQ(bounds.forward.upper, all[0].forward.upper);
    EXPECT_EQ(bounds.backward.lower, all[0].backward.lower);
    EXPECT_EQ(bounds.backward.upper, all[0].backward.upper);
  }
}

TEST(HausdorffBounds, DecideWhetherTheDistanceIsWithinALimit) {
  const Mesh a = built(torus(60, 30)).mesh;
  const Mesh b = built(torus(20, 10)).mesh;
  const analysis::DistanceInterval distance =
      analysis::hausdorff_bounds(a, b, {.ratio = 1.001}).two_sided();
  for (const double factor : {1.002, 1.1, 2.0, 10.0}) {
    const double enough = factor * distance.upper;
    const analysis::HausdorffBounds within =
        analysis::hausdorff_bounds(a, b, {.enough = enough, .is_decision = true});
    EXPECT_LE(within.two_sided().upper, enough) << factor;
  }
  for (const double factor : {0.998, 0.9, 0.1, 0.0}) {
    const double enough = factor * distance.lower;
    const analysis::HausdorffBounds beyond =
        analysis::hausdorff_bounds(a, b, {.enough = enough, .is_decision = true});
    EXPECT_GT(beyond.two_sided().lower, enough) << factor;
  }
}

TEST(HausdorffBounds, StayValidWhenTheWorkIsLimited) {
  const Mesh a = built(torus(60, 30)).mesh;
  const Mesh b = built(torus(20, 10)).mesh;
  const analysis::DistanceInterval limited =
      analysis::hausdorff_bounds(a, b, {.ratio = 1.0001, .most_queries = 8'000}).two_sided();
  const analysis::DistanceInterval distance =
      analysis::hausdorff_bounds(a, b, {.ratio = 1.001}).two_sided();
  EXPECT_LE(limited.lower, distance.upper);
  EXPECT_GE(limited.upper, distance.lower);
  EXPECT_GT(limited.upper, 1.0001 * limited.lower);
}

TEST(HausdorffBounds, StayValidWithPoorHints) {
  const Mesh a = built(torus(60, 30)).mesh;
  const Mesh b = built(torus(20, 10)).mesh;
  analysis::LazyTree tree_a(a);
  analysis::LazyTree tree_b(b);
  const std::vector<Face> hints_a(a.face_count(), Face(7));  // far from most triangles
  const std::vector<Face> hints_b(b.face_count(), Face(7));
  for (const double ratio : {1.05, 3.0}) {
    const analysis::HausdorffBounds with =
        analysis::hausdorff_bounds({a, tree_a, hints_a}, {b, tree_b, hints_b}, {.ratio = ratio});
    const analysis::DistanceInterval exact =
        analysis::hausdorff_bounds(a, b, {.ratio = 1.001}).two_sided();
    const auto [lower, upper] = with.two_sided();
    EXPECT_LE(lower, exact.upper);
    EXPECT_GE(upper, exact.lower);
    EXPECT_LE(upper, ratio * lower * (1 + 1e-9));
  }
}

TEST(HausdorffBounds, DecideTheSameWithAndWithoutHints) {
  const Mesh a = built(torus(60, 30)).mesh;
  const Mesh b = built(torus(20, 10)).mesh;
  const analysis::DistanceInterval distance =
      analysis::hausdorff_bounds(a, b, {.ratio = 1.001}).two_sided();
  analysis::LazyTree tree_a(a);
  analysis::LazyTree tree_b(b);
  const std::vector<Face> hints_a(a.face_count(), Face(0));
  const std::vector<Face> hints_b(b.face_count(), Face(0));
  for (const double factor : {0.5, 0.9, 0.998, 1.002, 1.1, 2.0}) {
    const double enough = factor * (factor < 1.0 ? distance.lower : distance.upper);
    const analysis::HausdorffBounds bounds =
        analysis::hausdorff_bounds({a, tree_a, hints_a}, {b, tree_b, hints_b},
                                   {.enough = enough, .is_decision = true, .finds_all = true});
    EXPECT_EQ(bounds.two_sided().upper <= enough, factor > 1.0) << factor;
    EXPECT_EQ(bounds.beyond.empty(), factor > 1.0) << factor;
  }
}

TEST(HausdorffBounds, HoldWithAnyHintsForRandomSoups) {
  for (std::uint32_t seed = 0; seed < (kSanitized ? 20U : 60U); ++seed) {
    SCOPED_TRACE(seed);
    const Mesh a = built(random_soup(seed)).mesh;
    const Mesh b = built(random_soup(seed + 1000)).mesh;
    if (a.face_count() == 0 || b.face_count() == 0) continue;
    std::mt19937 random(seed);
    const auto hints = [&](const Mesh& from, const Mesh& to) {
      std::vector<Face> result;
      for (std::uint32_t f = 0; f < from.face_count(); ++f)
        result.emplace_back(static_cast<std::uint32_t>(random() % to.face_count()));
      return result;
    };
    const std::vector<Face> hints_a = hints(a, b);
    const std::vector<Face> hints_b = hints(b, a);
    analysis::LazyTree tree_a(a);
    analysis::LazyTree tree_b(b);
    const analysis::HausdorffBounds bounds =
        analysis::hausdorff_bounds({a, tree_a, hints_a}, {b, tree_b, hints_b}, {.ratio = 3.0});
    const analysis::SurfaceDistance sampled = analysis::surface_distance(a, b, {.samples = 20'000});
    EXPECT_GE(bounds.forward.upper, sampled.forward.max);
    EXPECT_GE(bounds.backward.upper, sampled.backward.max);
    EXPECT_LE(bounds.two_sided().lower, 1.5 * sampled.two_sided().max);
  }
}

TEST(HausdorffBounds, StopWhenCanceled) {
  const Mesh mesh = built(cube()).mesh;
  Progress progress;
  progress.cancel();
  EXPECT_THROW((void)analysis::hausdorff_bounds(mesh, mesh, {.progress = &progress}), Cancelled);
}

}  // namespace
}  // namespace mesher::test
