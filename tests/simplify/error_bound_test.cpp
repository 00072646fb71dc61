#include "engine/simplify/error_bound.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "engine/analysis/distance.h"
#include "engine/analysis/hausdorff.h"
#include "engine/core/parallel.h"
#include "engine/mesh/statistics.h"
#include "engine/simplify/simplify.h"
#include "tests/simplify/replay.h"
#include "tests/support/meshes.h"
#include "tests/support/sanitized.h"

namespace mesher::test {
namespace {

Mesh wavy_sheet(std::uint32_t n) {
  Soup soup = grid(n);
  for (glm::vec3& p : soup.positions)
    p.z = std::sin(0.35F * p.x) * std::cos(0.2F * p.y);
  return built(std::move(soup)).mesh;
}

TEST(MaxError, HoldsInBothDirectionsAndIsMeasured) {
  for (const Mesh& mesh : {wavy_sheet(40), built(torus(60, 30)).mesh}) {
    const double diagonal = bounding_box(mesh).diagonal();
    std::uint32_t last = 0;
    for (const double percent : {0.02, 0.1, 0.5, 2.0}) {
      const double bound = percent / 100.0 * diagonal;
      const simplify::Simplified result =
          simplify::simplify(Mesh(mesh), {.target_faces = 0, .max_error = bound});
      expect_valid(result.mesh);
      EXPECT_EQ(topology(result.mesh), topology(mesh));
      EXPECT_LE(result.report.measured_error, bound);
      EXPECT_LE(result.report.certified_bound, bound);
      // Measure again with other samples.
      const analysis::SurfaceDistance d =
          analysis::surface_distance(mesh, result.mesh, {.samples = 77'777});
      EXPECT_LE(d.two_sided().max, bound * 1.02);
      EXPECT_TRUE(last == 0 || result.mesh.face_count() < last)
          << "a larger bound leaves fewer faces";
      EXPECT_GT(result.report.measured_error, 0.3 * bound) << "the run makes use of the bound";
      last = result.mesh.face_count();
    }
  }
}

/// A sheet with slits as wide as one square.
Mesh slit_sheet(std::uint32_t n) {
  Soup soup = grid(n);
  std::vector<std::uint32_t> kept;
  for (std::uint32_t square = 0; square < n * n; ++square) {
    const std::uint32_t x = square % n;
    const std::uint32_t y = square / n;
    if (x % 10 == 5 && y % 20 > 5 && y % 20 < 15) continue;
    for (std::uint32_t c = 6 * square; c < 6 * square + 6; ++c)
      kept.push_back(soup.corners[c]);
  }
  soup.corners.assign(kept.begin(), kept.end());
  return built(std::move(soup)).mesh;
}

// Many collapses are far cheaper than one across a slit, which must not affect all of them.
TEST(MaxError, NoFaceCrossesAHole) {
  const Mesh mesh = slit_sheet(60);
  for (std::size_t p = 0; p < simplify::kPlacements.size(); ++p) {
    const std::uint32_t target = mesh.face_count() / 5;
    const simplify::Simplified result =
        simplify::simplify(Mesh(mesh), {.target_faces = target,
                                        .max_error = 0.3,
                                        .cost = simplify::CostPolicy::edge_length,
                                        .placement = static_cast<simplify::Placement>(p)});
    EXPECT_EQ(result.mesh.face_count(), target) << key(static_cast<simplify::Placement>(p));
    EXPECT_LE(result.report.measured_error, 0.3);
  }
}

TEST(MaxError, StopsAtTheTargetBeforeTheBound) {
  const Mesh mesh = wavy_sheet(40);
  const simplify::Simplified result =
      simplify::simplify(Mesh(mesh), {.target_faces = 2'000, .max_error = 10.0});
  EXPECT_EQ(result.report.reason, simplify::StopReason::target_reached);
  EXPECT_EQ(result.mesh.face_count(), 2'000U);
  const simplify::Simplified bounded =
      simplify::simplify(Mesh(mesh), {.target_faces = 10, .max_error = 0.01});
  EXPECT_EQ(bounded.report.reason, simplify::StopReason::error_bound);
  EXPECT_GT(bounded.report[simplify::Rejection::error_bound], 0U);
  EXPECT_GT(bounded.mesh.face_count(), 10U);
}

TEST(MaxError, ZeroBoundRemovesOnlyFlatFaces) {
  // Flat on integer coordinates: collapses inside and along the boundary have no error.
  const Mesh sheet = built(grid(16)).mesh;
  const simplify::Simplified result =
      simplify::simplify(Mesh(sheet), {.target_faces = 0, .max_error = 1e-6});
  EXPECT_LT(result.mesh.face_count(), 20U);
  EXPECT_LE(result.report.measured_error, 1e-6);
  // On a wave every collapse has an error.
  const simplify::Simplified none =
      simplify::simplify(wavy_sheet(20), {.target_faces = 0, .max_error = 0.0});
  EXPECT_EQ(none.mesh.face_count(), 800U);
  EXPECT_EQ(none.report.reason, simplify::StopReason::error_bound);
  EXPECT_EQ(none.report.measured_error, 0.0);
}

TEST(MaxError, AgreesWithIndependentBounds) {
  const Mesh mesh = wavy_sheet(40);
  for (const double bound : {0.01, 0.05, 0.2}) {
    const simplify::Simplified result = simplify::simplify(Mesh(mesh), {.max_error = bound});
    EXPECT_LT(result.mesh.face_count(), mesh.face_count()) << bound;
    const analysis::DistanceInterval found =
        analysis::hausdorff_bounds(mesh, result.mesh, {.ratio = 1.01}).two_sided();
    EXPECT_LE(found.lower, bound);
  }
}

TEST(MaxError, SameForAnyThreadCount) {
  const Mesh mesh = built(torus(120, 60)).mesh;
  std::vector<simplify::Simplified> results;
  for (const unsigned threads : {1U, 2U}) {
    const ThreadLimit limit(threads);
    results.push_back(simplify::simplify(Mesh(mesh), {.max_error = 0.01}));
  }
  EXPECT_TRUE(is_same_surface(results[0].mesh, results[1].mesh));
  EXPECT_EQ(results[0].report.certified_bound, results[1].report.certified_bound);
}

TEST(CertifiedBound, LiesBetweenSamplesAndRatioTimesTheDistance) {
  for (const Mesh& mesh : {wavy_sheet(60), built(torus(90, 45)).mesh}) {
    for (const double part : {0.5, 0.1, 0.02}) {
      const auto target = static_cast<std::uint32_t>(part * mesh.face_count());
      const simplify::Simplified result =
          simplify::simplify(Mesh(mesh), {.target_faces = target, .certifies = true});
      const double sampled =
          analysis::surface_distance(mesh, result.mesh, {.samples = 100'000}).two_sided().max;
      EXPECT_GE(result.report.certified_bound, sampled) << part;
      const analysis::DistanceInterval distance =
          analysis::hausdorff_bounds(mesh, result.mesh, {.ratio = 1.05}).two_sided();
      EXPECT_LE(result.report.certified_bound, simplify::kBoundRatio * distance.upper) << part;
      EXPECT_LT(result.report.measured_error, 0.0);
    }
  }
}

// The run scales the model to other units.
TEST(CertifiedBound, HoldsForTinyAndHugeModels) {
  for (const float scale : {1e-30F, 1e-6F, 1e20F}) {
    Soup soup = grid(40);
    for (glm::vec3& p : soup.positions)
      p = scale * glm::vec3(p.x, p.y, std::sin(0.35F * p.x) * std::cos(0.2F * p.y));
    const Mesh mesh = built(std::move(soup)).mesh;
    const simplify::Simplified result =
        simplify::simplify(Mesh(mesh), {.target_faces = 400, .certifies = true});
    const double sampled =
        analysis::surface_distance(mesh, result.mesh, {.samples = kSanitized ? 10'000 : 50'000})
            .two_sided()
            .max;
    EXPECT_GE(result.report.certified_bound, sampled) << scale;
    EXPECT_LE(result.report.certified_bound, 1.5 * simplify::kBoundRatio * sampled) << scale;
  }
}

TEST(CertifiedBound, SameForAnyThreadCount) {
  const Mesh mesh = built(torus(120, 60)).mesh;
  std::vector<double> bounds;
  for (const unsigned threads : {1U, 2U, 4U}) {
    const ThreadLimit limit(threads);
    const simplify::Simplified result =
        simplify::simplify(Mesh(mesh), {.target_faces = 2'000, .certifies = true});
    bounds.push_back(result.report.certified_bound);
  }
  EXPECT_EQ(bounds[0], bounds[1]);
  EXPECT_EQ(bounds[0], bounds[2]);
}

TEST(CertifiedBound, IsComputedOnlyOnRequest) {
  const Mesh mesh = wavy_sheet(10);
  EXPECT_LT(simplify::simplify(Mesh(mesh), {.target_faces = 50}).report.certified_bound, 0.0);
}

TEST(MaxError, ObserverSeesOnlyTheFinalRun) {
  const Mesh mesh = wavy_sheet(30);
  simplify::CollapseRecorder recorder;
  const simplify::Simplified result =
      simplify::simplify(Mesh(mesh), {.target_faces = 0, .max_error = 0.05, .observer = &recorder});
  EXPECT_EQ(recorder.records().size(), result.report.collapses);
  const Mesh replayed = replay(Mesh(mesh), recorder.records(), [](const Mesh&, std::size_t) {});
  EXPECT_TRUE(is_same_surface(replayed, result.mesh));
}

}  // namespace
}  // namespace mesher::test
