// Simplification that stops before its estimated error exceeds a limit.
#include <gtest/gtest.h>

#include <cmath>

#include "engine/analysis/distance.h"
#include "engine/core/parallel.h"
#include "engine/simplify/simplify.h"
#include "tests/simplify/replay.h"
#include "tests/support/assets.h"
#include "tests/support/meshes.h"

namespace mesher::test {
namespace {

double percent_of_diagonal(const Mesh& mesh, double percent) {
  return 0.01 * percent * statistics(mesh).box.diagonal();
}

double rms(const Mesh& a, const Mesh& b) {
  const analysis::SurfaceDistance d = analysis::surface_distance(a, b, {.samples = 30'000});
  return std::sqrt(0.5 * (d.forward.rms * d.forward.rms + d.backward.rms * d.backward.rms));
}

TEST(ErrorStop, KeepsTheLimitAndReportsIt) {
  const Mesh mesh = asset("bunny.obj");
  for (const double percent : {0.2, 1.0, 3.0}) {
    const double limit = percent_of_diagonal(mesh, percent);
    const simplify::Simplified result =
        simplify::simplify(Mesh(mesh), {.target_faces = 4, .stop_before_error = limit});
    const simplify::SimplifyReport& report = result.report;
    EXPECT_EQ(report.reason, simplify::StopReason::far_from_input) << percent;
    EXPECT_LE(report.estimated_error, limit) << percent;
    EXPECT_LE(rms(mesh, result.mesh), 1.25 * limit) << percent;
    EXPECT_EQ(report.faces_reached, result.mesh.face_count());
    // A result with a fifth fewer faces exceeds the limit.
    const std::uint32_t fewer = result.mesh.face_count() * 4 / 5;
    EXPECT_GT(simplify::simplify(Mesh(mesh), {.target_faces = fewer}).report.estimated_error,
              0.9 * limit)
        << percent;
  }
}

TEST(ErrorStop, UndoneCollapsesLeaveAValidMeshThatMatchesTheRecord) {
  std::vector<Mesh> meshes;
  for (const char* name : {"bunny_1k.obj", "cactus.obj", "hypersheet.obj", "knot.obj",
                           "open_box.obj", "creased_cube.obj", "cube.obj"})
    meshes.push_back(asset(name));
  meshes.push_back(built(bow_tie({grid(12), cube(), grid(9)})).mesh);
  meshes.push_back(built(moebius(40)).mesh);
  for (Mesh& mesh : meshes) {
    if (mesh.face_count() > 500) mesh.set_sharpness(Vertex(100), 2.0F);
    for (const double percent : {0.3, 2.0, 6.0}) {
      for (const simplify::ResultOrder order :
           {simplify::ResultOrder::input, simplify::ResultOrder::fill_holes}) {
        simplify::CollapseRecorder recorder;
        const simplify::Simplified result =
            simplify::simplify(Mesh(mesh), {.stop_before_error = percent_of_diagonal(mesh, percent),
                                            .crease_angle_deg = 60.0F,
                                            .order = order,
                                            .observer = &recorder});
        expect_valid(result.mesh);
        EXPECT_EQ(topology(result.mesh), topology(mesh));
        EXPECT_EQ(result.report.collapses, recorder.records().size());
        EXPECT_EQ(result.vertex_source.size(), result.mesh.vertex_count());
        const Mesh replayed =
            replay(Mesh(mesh), recorder.records(), [](const Mesh&, std::size_t) {});
        EXPECT_TRUE(is_same_surface(replayed, result.mesh)) << percent;
        EXPECT_EQ(replayed.bow_tie_copies().size(), result.mesh.bow_tie_copies().size());
      }
    }
  }
}

TEST(ErrorStop, KeepsVertexSharpness) {
  Mesh mesh = asset("bunny_1k.obj");
  for (std::uint32_t v = 0; v < mesh.vertex_count(); v += 20)
    mesh.set_sharpness(Vertex(v), 1.0F + float(v));
  const simplify::Simplified result = simplify::simplify(
      Mesh(mesh), {.target_faces = 4, .stop_before_error = percent_of_diagonal(mesh, 1.0)});
  ASSERT_EQ(result.report.reason, simplify::StopReason::far_from_input);
  std::uint32_t sharp = 0;
  for (std::uint32_t v = 0; v < result.mesh.vertex_count(); ++v)
    sharp += result.mesh.sharpness(Vertex(v)) > 0.0F ? 1 : 0;
  EXPECT_EQ(sharp, (mesh.vertex_count() + 19) / 20);
}

TEST(ErrorStop, TargetIsReachedFirstWhenTheErrorIsSmall) {
  const Mesh mesh = asset("bunny.obj");
  const double limit = percent_of_diagonal(mesh, 5.0);
  const simplify::Simplified result =
      simplify::simplify(Mesh(mesh), {.target_faces = 500, .stop_before_error = limit});
  EXPECT_EQ(result.report.reason, simplify::StopReason::target_reached);
  EXPECT_EQ(result.mesh.face_count(), 500U);
  // Running in steps costs little accuracy.
  const simplify::Simplified plain = simplify::simplify(Mesh(mesh), {.target_faces = 500});
  EXPECT_LE(rms(mesh, result.mesh), 1.1 * rms(mesh, plain.mesh));
}

TEST(ErrorStop, AppliesOnlyBelowTheGivenFaceCount) {
  const Mesh mesh = asset("bunny_1k.obj");
  const double limit = percent_of_diagonal(mesh, 0.1);
  const simplify::Simplified result = simplify::simplify(
      Mesh(mesh), {.target_faces = 20, .stop_before_error = limit, .stop_below_faces = 300});
  EXPECT_EQ(result.report.reason, simplify::StopReason::far_from_input);
  EXPECT_EQ(result.mesh.face_count(), 300U);
  const simplify::Simplified free = simplify::simplify(
      Mesh(mesh), {.target_faces = 20, .stop_before_error = limit, .stop_below_faces = 1});
  EXPECT_EQ(free.mesh.face_count(), 20U);
}

TEST(ErrorStop, ZeroAllowsNoCollapseOnACurvedSurface) {
  const Mesh mesh = built(torus(30, 20)).mesh;
  const simplify::Simplified result =
      simplify::simplify(Mesh(mesh), {.target_faces = 4, .stop_before_error = 0.0});
  EXPECT_EQ(result.report.reason, simplify::StopReason::far_from_input);
  EXPECT_EQ(result.mesh.face_count(), mesh.face_count());
  EXPECT_EQ(result.report.collapses, 0U);
  // The error of single precision; the torus has a size of 8.
  EXPECT_LT(result.report.estimated_error, 1e-7);
}

TEST(ErrorStop, CombinesWithBoundAndNoIntersections) {
  const Mesh mesh = asset("knot.obj");
  const double limit = percent_of_diagonal(mesh, 0.5);
  const simplify::Simplified result = simplify::simplify(Mesh(mesh), {.target_faces = 4,
                                                                      .max_error = 4.0 * limit,
                                                                      .stop_before_error = limit,
                                                                      .no_intersections = true});
  expect_valid(result.mesh);
  EXPECT_LE(result.report.estimated_error, limit);
  EXPECT_LE(result.report.certified_bound, 4.0 * limit);
  EXPECT_LT(result.mesh.face_count(), mesh.face_count());
}

TEST(ErrorStop, SameBytesForAnyThreadCount) {
  const Mesh mesh = asset("bunny.obj");
  std::vector<simplify::Simplified> results;
  for (const unsigned threads : {1U, 3U}) {
    const ThreadLimit limit(threads);
    results.push_back(simplify::simplify(
        Mesh(mesh), {.target_faces = 4, .stop_before_error = percent_of_diagonal(mesh, 1.0)}));
  }
  EXPECT_TRUE(is_identical(results[0].mesh, results[1].mesh));
  EXPECT_EQ(results[0].report.estimated_error, results[1].report.estimated_error);
}

}  // namespace
}  // namespace mesher::test
