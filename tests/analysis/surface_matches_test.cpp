#include "engine/analysis/surface_matches.h"

#include <glm/geometric.hpp>

#include "engine/analysis/spread.h"
#include "engine/core/error.h"
#include "engine/core/parallel.h"
#include "tests/analysis/painted.h"

namespace mesher::test {
namespace {

TEST(NearestWeights, ArePositionsOfNearestPoints) {
  const std::array<glm::dvec3, 3> t{{{0, 0, 0}, {4, 0, 0}, {0, 4, 0}}};
  EXPECT_EQ(analysis::nearest_weights({1, 1, 5}, t), glm::dvec3(0.5, 0.25, 0.25));
  EXPECT_EQ(analysis::nearest_weights({-1, -1, 0}, t), glm::dvec3(1, 0, 0));
  EXPECT_EQ(analysis::nearest_weights({2, -3, 1}, t), glm::dvec3(0.5, 0.5, 0));
  EXPECT_EQ(analysis::nearest_weights({3, 3, 0}, t), glm::dvec3(0, 0.5, 0.5));
}

TEST(NearestWeights, TriangleWithoutAreaCountsAsItsSides) {
  const std::array<glm::dvec3, 3> line{{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}};
  const glm::dvec3 w = analysis::nearest_weights({1.5, 1, 0}, line);
  EXPECT_DOUBLE_EQ(w.y + 2.0 * w.z, 1.5);
  const std::array<glm::dvec3, 3> point{};
  EXPECT_EQ(analysis::nearest_weights({1, 1, 1}, point), glm::dvec3(1, 0, 0));
}

// Squared distances agree with the other implementation.
TEST(NearestWeights, AgreeWithSquaredDistance) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> number(-1.0, 1.0);
  const auto point = [&] { return glm::dvec3(number(random), number(random), number(random)); };
  for (int i = 0; i < 5000; ++i) {
    const std::array<glm::dvec3, 3> t{point(), point(), point()};
    const glm::dvec3 p = point();
    const glm::dvec3 w = analysis::nearest_weights(p, t);
    const glm::dvec3 off = p - (w.x * t[0] + w.y * t[1] + w.z * t[2]);
    EXPECT_NEAR(glm::dot(off, off), analysis::squared_distance(p, t), 1e-12);
  }
}

TEST(SurfaceMatches, EverySampleHasItsNearestPoints) {
  const Painted a = painted(torus(12, 8), {});
  const Painted b = painted(torus(9, 5), {});
  const analysis::TriangleTree tree(b.mesh);
  const analysis::SurfaceMatches matches = matches_of(a, b);
  EXPECT_NEAR(double(matches.count()), 2000.0, 2.0);
  for (std::size_t i = 0; i < matches.count(); ++i) {
    const glm::dvec3 p = analysis::position_of(a.mesh, matches.sample(i));
    ASSERT_GE(matches.candidates(i).size(), 1U);
    for (const analysis::SurfacePoint& candidate : matches.candidates(i)) {
      const glm::dvec3 off = p - analysis::position_of(b.mesh, candidate);
      EXPECT_NEAR(glm::length(off), std::sqrt(tree.nearest(p).squared_distance), 2e-5);
    }
  }
}

TEST(SurfaceMatches, AreTheSameForAnyNumberOfThreads) {
  const Painted a = painted(torus(30, 20), {});
  const Painted b = painted(torus(9, 5), {});
  std::vector<std::size_t> counts;
  for (const unsigned threads : {1U, 2U, 5U}) {
    const ThreadLimit limit(threads);
    const analysis::SurfaceMatches matches = matches_of(a, b, 20'000);
    std::size_t sum = 0;
    for (std::size_t i = 0; i < matches.count(); ++i) {
      for (const analysis::SurfacePoint& candidate : matches.candidates(i))
        sum = 31 * sum + candidate.face.index();
    }
    counts.push_back(sum);
  }
  EXPECT_EQ(counts[0], counts[1]);
  EXPECT_EQ(counts[0], counts[2]);
}

TEST(SurfaceMatches, SurfaceWithoutAreaHasNoSamples) {
  const Painted line = painted(soup_of({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}, {0, 1, 2}), {});
  EXPECT_EQ(matches_of(line, sheet_with(2, {})).count(), 0U);
  EXPECT_GT(matches_of(sheet_with(2, {}), line).count(), 0U);
}

TEST(SurfaceMatches, MeshOfManyFacesAtOnePointHasFewCandidates) {
  Soup fan;
  fan.positions.push_back({0, 0, 0});
  for (int i = 0; i < 100; ++i)
    fan.positions.push_back({std::cos(0.06F * float(i)), std::sin(0.06F * float(i)), 0.0F});
  for (std::uint32_t i = 1; i < 100; ++i)
    for (const std::uint32_t v : {0U, i, i + 1})
      fan.corners.push_back(v);
  const BuildResult mesh = built(std::move(fan));
  const analysis::TriangleTree tree(mesh.mesh);
  analysis::NearestPoints nearest(tree, analysis::equally_near(mesh.mesh));
  EXPECT_EQ(nearest.nearest({0, 0, 1}).size(), analysis::NearestPoints::kMostCandidates);
}

TEST(SurfaceMatches, CancellationStops) {
  Progress progress;
  progress.cancel();
  const Painted a = sheet_with(4, {});
  EXPECT_THROW((void)analysis::match_surfaces(a.mesh, a.mesh, analysis::TriangleTree(a.mesh), 100,
                                              &progress),
               Cancelled);
}

TEST(Spread, FiguresAreThoseOfFiniteValues) {
  std::vector<float> values{kNoNumber, std::numeric_limits<float>::infinity()};
  for (int i = 100; i >= 1; --i)
    values.push_back(float(i));
  const analysis::Spread spread(values);
  EXPECT_EQ(spread.count(), 100U);
  EXPECT_DOUBLE_EQ(spread.mean(), 50.5);
  EXPECT_DOUBLE_EQ(spread.rms(), std::sqrt(101.0 * 201.0 / 6.0));
  EXPECT_EQ(spread.percentile(0.5), 50.0);
  EXPECT_EQ(spread.percentile(0.95), 95.0);
  EXPECT_EQ(spread.percentile(0.0), 1.0);
  EXPECT_EQ(spread.max(), 100.0);
  EXPECT_EQ(analysis::Spread().percentile(0.9), 0.0);
  EXPECT_EQ(analysis::Spread().max(), 0.0);
}

}  // namespace
}  // namespace mesher::test
