#include "engine/simplify/attempts.h"

#include <gtest/gtest.h>

#include <cmath>
#include <optional>
#include <random>
#include <vector>

#include "engine/analysis/hausdorff.h"
#include "engine/analysis/triangle_tree.h"
#include "engine/core/parallel.h"
#include "engine/mesh/statistics.h"
#include "engine/simplify/measured.h"
#include "engine/simplify/recheck.h"
#include "tests/simplify/replay.h"
#include "tests/support/meshes.h"

namespace mesher::test {
namespace {

constexpr double kBound = 0.05;

Mesh bumpy_sheet() {
  Soup soup = grid(60);
  for (glm::vec3& p : soup.positions)
    p.z = std::sin(0.35F * p.x) * std::cos(0.2F * p.y);
  return built(std::move(soup)).mesh;
}

struct Attempt {
  simplify::Simplified result;
  simplify::Trace trace;
};

/// Runs once under the bound, repeating the last run of `attempts`, if any.
Attempt attempt(const Mesh& mesh, simplify::Attempts& attempts,
                simplify::CollapseObserver* observer = nullptr) {
  Attempt run;
  run.result = simplify::simplify_unmeasured(
      Mesh(mesh), {.max_error = kBound, .observer = observer}, &run.trace, &attempts);
  return run;
}

/// Tightens the bound to a part of it at the vertices of the input within a distance of a point.
void tighten_near(simplify::Attempts& attempts, const Mesh& input, const glm::vec3& center,
                  float radius, float part) {
  attempts.shares.assign(input.vertex_count(), 1.0F);
  for (std::uint32_t v = 0; v < input.vertex_count(); ++v) {
    if (glm::distance(input.position(Vertex(v)), center) < radius) attempts.shares[v] = part;
  }
}

analysis::HausdorffBounds decided(const Attempt& run) {
  analysis::LazyTree before(run.trace.before);
  analysis::LazyTree after(run.trace.after);
  return analysis::hausdorff_bounds({run.trace.before, before, run.trace.near_before},
                                    {run.trace.after, after, run.trace.near_after},
                                    {.enough = kBound, .is_decision = true, .finds_all = true});
}

TEST(Attempts, RepeatUnderTheSameBoundGivesTheSameResult) {
  for (const Mesh& mesh : {bumpy_sheet(), built(torus(60, 30)).mesh}) {
    simplify::Attempts attempts;
    const Attempt first = attempt(mesh, attempts);
    ASSERT_LT(first.result.mesh.face_count(), mesh.face_count() / 4);
    const std::size_t steps = attempts.steps.size();
    const Attempt second = attempt(mesh, attempts);
    EXPECT_EQ(attempts.steps.size(), steps);
    EXPECT_TRUE(is_same_surface(first.result.mesh, second.result.mesh));
    EXPECT_EQ(second.result.report.collapses, first.result.report.collapses);
    EXPECT_EQ(second.result.report.rejected, first.result.report.rejected);
    EXPECT_EQ(second.result.report.reason, simplify::StopReason::error_bound);
  }
}

// The result is finer where the bound became tighter, and elsewhere the same faces as before.
TEST(Attempts, RepeatUnderATighterBoundChangesThatPlaceOnly) {
  const Mesh mesh = bumpy_sheet();
  simplify::Attempts attempts;
  const Attempt first = attempt(mesh, attempts);
  const glm::vec3 center = mesh.position(Vertex(10 * 61 + 10));
  tighten_near(attempts, first.trace.before, center, 8.0F, 0.1F);
  simplify::CollapseRecorder recorder;
  const Attempt second = attempt(mesh, attempts, &recorder);
  expect_valid(second.result.mesh);
  EXPECT_EQ(topology(second.result.mesh), topology(mesh));
  const auto faces_near = [&](const Mesh& of, float radius) {
    std::uint32_t count = 0;
    for (std::uint32_t f = 0; f < of.face_count(); ++f) {
      glm::vec3 middle(0.0F);
      for (std::uint32_t c = 0; c < 3; ++c)
        middle += of.position(of.origin(Mesh::halfedge(Face(f), c))) / 3.0F;
      count += glm::distance(middle, center) < radius ? 1U : 0U;
    }
    return count;
  };
  EXPECT_GT(faces_near(second.result.mesh, 8.0F), 2 * faces_near(first.result.mesh, 8.0F));
  // What is not repeated reaches as far as the merged vertices around did.
  const std::uint32_t far_before =
      first.result.mesh.face_count() - faces_near(first.result.mesh, 35.0F);
  const std::uint32_t far_after =
      second.result.mesh.face_count() - faces_near(second.result.mesh, 35.0F);
  EXPECT_EQ(far_after, far_before);
  // Each collapse is legal after those before it, and together they give the result.
  const Mesh replayed = replay(Mesh(mesh), recorder.records(), [](const Mesh&, std::size_t) {});
  EXPECT_TRUE(is_same_surface(replayed, second.result.mesh));
}

// Wherever the bound becomes tighter, only collapses whose surroundings are as before are repeated:
// all are legal, and the mesh stays valid.
TEST(Attempts, RepeatedCollapsesAreLegal) {
  std::mt19937 random(1);
  for (const Mesh& mesh : {bumpy_sheet(), built(torus(60, 30)).mesh}) {
    for (int i = 0; i < 20; ++i) {
      simplify::Attempts attempts;
      const Attempt first = attempt(mesh, attempts);
      attempts.shares.assign(mesh.vertex_count(), 1.0F);
      for (int k = 0; k < 8; ++k)
        attempts.shares[random() % mesh.vertex_count()] = 0.02F * static_cast<float>(1 + k);
      simplify::CollapseRecorder recorder;
      const Attempt second = attempt(mesh, attempts, &recorder);
      expect_valid(second.result.mesh);
      EXPECT_EQ(topology(second.result.mesh), topology(mesh));
      EXPECT_FALSE(is_same_surface(first.result.mesh, second.result.mesh));
      const Mesh replayed = replay(Mesh(mesh), recorder.records(), [](const Mesh&, std::size_t) {});
      EXPECT_TRUE(is_same_surface(replayed, second.result.mesh));
    }
  }
}

// The first run stopped at its target, so collapses are left elsewhere.
TEST(Attempts, RepeatStillReachesTheTarget) {
  const Mesh mesh = bumpy_sheet();
  const simplify::SimplifyOptions options{.target_faces = 1200, .max_error = kBound};
  simplify::Attempts attempts;
  simplify::Trace trace;
  ASSERT_EQ(simplify::simplify_unmeasured(Mesh(mesh), options, &trace, &attempts).mesh.face_count(),
            1200U);
  tighten_near(attempts, trace.before, mesh.position(Vertex(30 * 61 + 30)), 4.0F, 0.02F);
  const simplify::Simplified second =
      simplify::simplify_unmeasured(Mesh(mesh), options, &trace, &attempts);
  expect_valid(second.mesh);
  EXPECT_EQ(second.mesh.face_count(), 1200U);
  EXPECT_EQ(second.report.reason, simplify::StopReason::target_reached);
}

TEST(Attempts, AreTheSameForAnyNumberOfThreads) {
  const Mesh mesh = built(torus(160, 80)).mesh;
  std::vector<std::vector<glm::vec3>> results;
  for (const unsigned threads : {1U, 2U, 7U}) {
    const ThreadLimit limit(threads);
    simplify::Attempts attempts;
    const Attempt first = attempt(mesh, attempts);
    tighten_near(attempts, first.trace.before, mesh.position(Vertex(0)), 1.0F, 0.3F);
    const Attempt second = attempt(mesh, attempts);
    const auto positions = second.result.mesh.positions();
    results.emplace_back(positions.begin(), positions.end());
  }
  EXPECT_EQ(results[0], results[1]);
  EXPECT_EQ(results[0], results[2]);
}

// Deciding only the faces to recheck finds the same faces as deciding all of them.
TEST(Recheck, CoversAllFacesWhoseDistanceChanged) {
  const Mesh mesh = bumpy_sheet();
  simplify::Attempts attempts;
  Attempt first = attempt(mesh, attempts);
  const analysis::HausdorffBounds earlier = decided(first);
  ASSERT_FALSE(earlier.beyond.empty()) << "the bound is exceeded between the checked points";
  tighten_near(attempts, first.trace.before, mesh.position(Vertex(30 * 61 + 30)), 4.0F, 0.1F);
  const Attempt second = attempt(mesh, attempts);
  analysis::LazyTree before(second.trace.before);
  const std::optional<simplify::Recheck> recheck = simplify::faces_to_recheck(
      second.trace, {std::move(first.trace.after), std::move(first.trace.near_after), earlier},
      kBound, before);
  ASSERT_TRUE(recheck.has_value());
  EXPECT_LT(recheck->before.size(), second.trace.before.face_count() / 2);
  EXPECT_LT(recheck->after.size(), second.trace.after.face_count() / 2);
  const analysis::HausdorffBounds all = decided(second);
  analysis::LazyTree after(second.trace.after);
  analysis::HausdorffSide input{second.trace.before, before, second.trace.near_before};
  analysis::HausdorffSide result{second.trace.after, after, second.trace.near_after};
  input.only = recheck->before;
  result.only = recheck->after;
  const analysis::HausdorffBounds some = analysis::hausdorff_bounds(
      input, result, {.enough = kBound, .is_decision = true, .finds_all = true});
  EXPECT_EQ(some.beyond, all.beyond);
  EXPECT_EQ(some.beyond_of_second, all.beyond_of_second);
}

TEST(Recheck, KeepsFacesBeyondTheBoundIfNothingChanged) {
  const Mesh mesh = bumpy_sheet();
  simplify::Attempts attempts;
  const Attempt run = attempt(mesh, attempts);
  const analysis::HausdorffBounds bounds = decided(run);
  ASSERT_FALSE(bounds.beyond.empty());
  analysis::LazyTree before(run.trace.before);
  const std::optional<simplify::Recheck> recheck = simplify::faces_to_recheck(
      run.trace, {Mesh(run.trace.after), run.trace.near_after, bounds}, kBound, before);
  ASSERT_TRUE(recheck.has_value());
  EXPECT_EQ(recheck->before, bounds.beyond);
  EXPECT_EQ(recheck->after, bounds.beyond_of_second);
}

TEST(Recheck, GivesUpIfEverythingChanged) {
  const Mesh mesh = bumpy_sheet();
  simplify::Attempts attempts;
  Attempt first = attempt(mesh, attempts);
  const analysis::HausdorffBounds earlier = decided(first);
  attempts.shares.assign(mesh.vertex_count(), 0.1F);
  const Attempt second = attempt(mesh, attempts);
  analysis::LazyTree before(second.trace.before);
  EXPECT_FALSE(simplify::faces_to_recheck(
                   second.trace,
                   {std::move(first.trace.after), std::move(first.trace.near_after), earlier},
                   kBound, before)
                   .has_value());
}

}  // namespace
}  // namespace mesher::test
