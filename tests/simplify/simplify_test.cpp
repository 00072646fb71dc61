#include "engine/simplify/simplify.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <cmath>
#include <optional>
#include <set>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "engine/analysis/distance.h"
#include "engine/core/error.h"
#include "engine/core/parallel.h"
#include "engine/mesh/collapse.h"
#include "engine/mesh/statistics.h"
#include "tests/simplify/replay.h"
#include "tests/support/meshes.h"
#include "tests/support/sanitized.h"
#include "tests/support/watched.h"

namespace mesher::test {
namespace {

Mesh bumpy_torus(std::uint32_t n, std::uint32_t m) {
  Soup soup = torus(n, m);
  for (std::size_t i = 0; i < soup.positions.size(); ++i) {
    const auto x = static_cast<float>(i);
    soup.positions[i] *= 1.0F + 0.03F * std::sin(0.7F * x) * std::cos(0.13F * x);
  }
  return built(std::move(soup)).mesh;
}

TEST(Simplify, SameBytesForAnyThreadCount) {
  // The mesh is large enough for several regions per round.
  const Mesh mesh = bumpy_torus(260, kSanitized ? 50 : 120);
  for (std::size_t p = 0; p < simplify::kCostPolicies.size(); ++p) {
    SCOPED_TRACE(key(static_cast<simplify::CostPolicy>(p)));
    std::optional<simplify::Simplified> first;
    Array<simplify::CollapseRecord> first_records;
    for (const unsigned threads : {1U, 2U, 5U}) {
      const ThreadLimit limit(threads);
      simplify::CollapseRecorder recorder;
      simplify::Simplified result =
          simplify::simplify(Mesh(mesh), {.target_faces = 1'000,
                                          .cost = static_cast<simplify::CostPolicy>(p),
                                          .observer = &recorder});
      if (!first) {
        first = std::move(result);
        first_records = recorder.records();
        continue;
      }
      EXPECT_TRUE(is_identical(first->mesh, result.mesh));
      EXPECT_EQ(first->vertex_source, result.vertex_source);
      EXPECT_EQ(first->report.rejected, result.report.rejected);
      ASSERT_EQ(first_records.size(), recorder.records().size());
      for (std::size_t i = 0; i < first_records.size(); ++i) {
        ASSERT_EQ(first_records[i].halfedge, recorder.records()[i].halfedge);
        ASSERT_EQ(first_records[i].position, recorder.records()[i].position);
      }
    }
  }
}

TEST(Simplify, RecordsOfManyRegionsAreLegalInSequence) {
  const Mesh mesh = bumpy_torus(150, 80);
  simplify::CollapseRecorder recorder;
  const simplify::Simplified result =
      simplify::simplify(Mesh(mesh), {.target_faces = 400, .observer = &recorder});
  const Mesh replayed = replay(Mesh(mesh), recorder.records(), [](const Mesh&, std::size_t) {});
  expect_valid(replayed);
  EXPECT_TRUE(is_same_surface(replayed, result.mesh));
}

TEST(Simplify, ReachesOddTargetsOnMeshesWithBoundary) {
  const Mesh sheet = built(grid(20)).mesh;
  for (const std::uint32_t target : {701U, 700U, 333U, 100U, 57U, 56U, 3U, 2U}) {
    const simplify::Simplified result = simplify::simplify(Mesh(sheet), {.target_faces = target});
    EXPECT_EQ(result.mesh.face_count(), target);
    EXPECT_EQ(result.report.reason, simplify::StopReason::target_reached);
    expect_valid(result.mesh);
  }
  const Mesh closed = bumpy_torus(12, 9);
  EXPECT_EQ(simplify::simplify(Mesh(closed), {.target_faces = 101}).mesh.face_count(), 100U);
}

TEST(Simplify, ReportsRequestedAndReachedFaces) {
  const Mesh mesh = bumpy_torus(12, 9);
  const simplify::Simplified none = simplify::simplify(Mesh(mesh), {.target_faces = 1'000});
  EXPECT_EQ(none.report.reason, simplify::StopReason::already_there);
  EXPECT_TRUE(is_identical(none.mesh, mesh));
  EXPECT_EQ(none.report.collapses, 0U);
  EXPECT_EQ(none.report.estimated_error, 0.0);

  const simplify::Simplified all = simplify::simplify(Mesh(mesh), {.target_faces = 0});
  EXPECT_EQ(all.report.reason, simplify::StopReason::no_legal_collapse);
  EXPECT_EQ(all.report.faces_before, 216U);
  EXPECT_EQ(all.report.faces_asked, 0U);
  EXPECT_GE(all.report.faces_reached, 14U) << "no torus has fewer faces (Moebius torus)";
  EXPECT_LT(all.report.faces_reached, 40U);
  EXPECT_GT(all.report[simplify::Rejection::link_condition], 0U);
  EXPECT_GT(all.report.estimated_error, 0.0);
  EXPECT_LT(all.report.measured_error, 0.0) << "no bound was requested";
  EXPECT_GT(all.report.seconds.total(), 0.0);
}

std::uint64_t refused_edges(const simplify::SimplifyReport& report) {
  std::uint64_t sum = 0;
  for (const std::uint64_t edges : report.rejected)
    sum += edges;
  return sum;
}

/// Counts the edges that cannot be collapsed in either direction without changing the topology.
std::uint64_t blocked_edges(const Mesh& mesh) {
  std::uint64_t count = 0;
  for (std::uint32_t i = 0; i < mesh.halfedge_count(); ++i) {
    const Halfedge h(i);
    if (h < mesh.twin(h) && !check_collapse(mesh, h).is_legal()) ++count;
  }
  return count;
}

TEST(Simplify, EachRefusedEdgeCountsOnce) {
  const simplify::Simplified one =
      simplify::simplify(built(tetrahedron()).mesh, {.target_faces = 0});
  EXPECT_EQ(one.report[simplify::Rejection::link_condition], 6U);
  EXPECT_EQ(refused_edges(one.report), 6U);
  // As many as are simplified in parallel regions.
  Soup soup;
  const Soup single = tetrahedron();
  for (int i = 0; i < 4'000; ++i) {
    for (const std::uint32_t corner : single.corners)
      soup.corners.push_back(corner + static_cast<std::uint32_t>(soup.positions.size()));
    for (const glm::vec3& p : single.positions)
      soup.positions.push_back(p + glm::vec3(3 * i, 0, 0));
  }
  const Mesh many = built(std::move(soup)).mesh;
  ASSERT_EQ(blocked_edges(many), 24'000U);
  const simplify::Simplified all = simplify::simplify(Mesh(many), {.target_faces = 0});
  EXPECT_EQ(all.report.collapses, 0U);
  EXPECT_EQ(all.report[simplify::Rejection::link_condition], 24'000U);
}

TEST(Simplify, EdgesRefusedByBoundCountOnce) {
  const Mesh mesh = bumpy_torus(60, 40);
  const simplify::Simplified result =
      simplify::simplify(Mesh(mesh), {.target_faces = 0, .max_error = 1e-9});
  EXPECT_EQ(result.report.reason, simplify::StopReason::error_bound);
  EXPECT_EQ(result.report.collapses, 0U);
  EXPECT_EQ(refused_edges(result.report), mesh.halfedge_count() / 2);
}

TEST(Simplify, RefusalsAreAtMostTheEdges) {
  const Mesh mesh = bumpy_torus(120, 90);
  const simplify::Simplified result = simplify::simplify(Mesh(mesh), {.target_faces = 0});
  EXPECT_EQ(result.report.reason, simplify::StopReason::no_legal_collapse);
  EXPECT_GE(refused_edges(result.report), result.mesh.halfedge_count() / 2) << "all that are left";
  EXPECT_LE(refused_edges(result.report), mesh.halfedge_count() / 2);
  // What cannot be simplified further has no other edges than refused ones.
  const simplify::Simplified again = simplify::simplify(Mesh(result.mesh), {.target_faces = 0});
  EXPECT_EQ(again.report.collapses, 0U);
  EXPECT_EQ(refused_edges(again.report), result.mesh.halfedge_count() / 2);
  EXPECT_GE(refused_edges(again.report), blocked_edges(result.mesh));
}

TEST(Simplify, LeavesEmptyMeshAndIsolatedVerticesUnchanged) {
  EXPECT_EQ(simplify::simplify(Mesh(), {.target_faces = 0}).report.reason,
            simplify::StopReason::already_there);
  Soup soup = join(torus(12, 9), soup_of({{9, 9, 9}, {8, 8, 8}}, {}));
  const Mesh mesh = built(std::move(soup), {.keep_isolated_vertices = true}).mesh;
  for (const simplify::ResultOrder order :
       {simplify::ResultOrder::input, simplify::ResultOrder::fill_holes}) {
    const simplify::Simplified result =
        simplify::simplify(Mesh(mesh), {.target_faces = 50, .order = order});
    expect_valid(result.mesh);
    std::uint32_t isolated = 0;
    for (std::uint32_t v = 0; v < result.mesh.vertex_count(); ++v)
      isolated += result.mesh.is_isolated(Vertex(v)) ? 1 : 0;
    EXPECT_EQ(isolated, 2U);
  }
}

TEST(Simplify, DistantIsolatedVertexDoesNotChangeTheScale) {
  const Mesh near = built(torus(60, 40)).mesh;
  const Mesh with_far = built(join(torus(60, 40), soup_of({{1e30F, 1e30F, 1e30F}}, {})),
                              {.keep_isolated_vertices = true})
                            .mesh;
  const simplify::Simplified result = simplify::simplify(Mesh(with_far), {.target_faces = 300});
  EXPECT_EQ(result.mesh.face_count(), 300U);
  EXPECT_LE(count_folds(result.mesh), count_folds(near));
  EXPECT_NEAR(result.report.estimated_error,
              simplify::simplify(Mesh(near), {.target_faces = 300}).report.estimated_error, 0.01);
}

TEST(Simplify, EndpointPlacementUsesOnlyInputPositions) {
  const Mesh mesh = bumpy_torus(60, 40);
  std::set<std::array<float, 3>> input;
  for (const glm::vec3& p : mesh.positions())
    input.insert({p.x, p.y, p.z});
  for (const float scale : {1.0F, 0x1p-30F, 0x1p40F}) {
    MeshArrays arrays = MeshArrays::take(Mesh(mesh));
    for (glm::vec3& p : arrays.position)
      p *= scale;
    const simplify::Simplified result =
        simplify::simplify(std::move(arrays).finish(),
                           {.target_faces = 300, .placement = simplify::Placement::endpoint});
    EXPECT_EQ(result.mesh.face_count(), 300U);
    for (const glm::vec3& p : result.mesh.positions())
      EXPECT_TRUE(input.contains({p.x / scale, p.y / scale, p.z / scale}));
  }
}

TEST(Simplify, DoesNotDependOnScaleOrPosition) {
  const Mesh mesh = bumpy_torus(40, 30);
  const simplify::Simplified plain = simplify::simplify(Mesh(mesh), {.target_faces = 200});
  for (const float scale : {0x1p-60F, 0x1p-20F, 0x1p8F, 0x1p55F}) {
    MeshArrays arrays = MeshArrays::take(Mesh(mesh));
    for (glm::vec3& p : arrays.position)
      p *= scale;
    const simplify::Simplified scaled =
        simplify::simplify(std::move(arrays).finish(), {.target_faces = 200});
    ASSERT_EQ(scaled.mesh.vertex_count(), plain.mesh.vertex_count());
    EXPECT_NEAR(scaled.report.estimated_error / double{scale}, plain.report.estimated_error,
                1e-3 * plain.report.estimated_error);
  }
}

TEST(Simplify, KeepsTheVolumeOfAClosedSurface) {
  const Mesh mesh = bumpy_torus(100, 60);
  const double before = statistics(mesh).volume;
  const double after =
      statistics(simplify::simplify(Mesh(mesh), {.target_faces = 600}).mesh).volume;
  EXPECT_NEAR(after / before, 1.0, 0.01);
  const double midpoints =
      statistics(simplify::simplify(
                     Mesh(mesh), {.target_faces = 600, .placement = simplify::Placement::midpoint})
                     .mesh)
          .volume;
  EXPECT_GT(std::abs(midpoints - before), 3.0 * std::abs(after - before));
}

TEST(Simplify, ReportsProgressAndStopsWhenCanceled) {
  class Canceller : public simplify::CollapseObserver {
   public:
    explicit Canceller(Progress& progress) : progress_(progress) {}
    void collapsed(std::span<const simplify::CollapseRecord>) override { progress_.cancel(); }

   private:
    Progress& progress_;
  };
  Progress progress;
  Canceller canceller(progress);
  EXPECT_THROW(static_cast<void>(simplify::simplify(
                   bumpy_torus(260, 120),
                   {.target_faces = 100, .observer = &canceller, .progress = &progress})),
               Cancelled);
  Progress whole;
  static_cast<void>(
      simplify::simplify(bumpy_torus(60, 40), {.target_faces = 100, .progress = &whole}));
  EXPECT_EQ(whole.fraction(), 1.0F);
}

TEST(Simplify, HasOneProgressForEveryWayToStop) {
  const Mesh mesh = bumpy_torus(300, 200);
  const std::vector<std::string> run{"preparing", "simplifying", "finishing"};
  const auto with = [&](std::vector<std::string> more, simplify::SimplifyOptions options) {
    const auto simplify = [&](Progress* progress) {
      options.progress = progress;
      static_cast<void>(simplify::simplify(Mesh(mesh), options));
    };
    std::vector<std::string> order = run;
    order.insert(order.end(), more.begin(), more.end());
    expect_one_progress(watched(simplify), order);
  };
  with({}, {.target_faces = 1'000});
  with({}, {.target_faces = 100'000});
  with({}, {.target_faces = 1'000, .no_intersections = true});
  with({"bounding the distance"}, {.target_faces = 1'000, .certifies = true});
  // Another run follows if one was beyond the bound.
  std::vector<std::string> runs{"bounding the distance"};
  for (int i = 0; i < 12; ++i)
    runs.insert(runs.end(), {"preparing", "simplifying", "finishing", "bounding the distance"});
  with(runs, {.max_error = 0.01});
}

TEST(Simplify, CanBeCanceledAtAnyMoment) {
  const Mesh mesh = bumpy_torus(kSanitized ? 180 : 900, 600);
  cancel_at_many_moments("simplifying", [&](Progress* progress) {
    static_cast<void>(
        simplify::simplify(Mesh(mesh), {.target_faces = 1'000, .progress = progress}));
  });
}

TEST(Simplify, ProgressFollowsTheTime) {
  const Mesh mesh = bumpy_torus(900, 600);
  Progress progress;
  std::vector<std::pair<double, float>> seen;
  std::atomic<bool> is_done{false};
  const auto start = std::chrono::steady_clock::now();
  std::thread watcher([&] {
    while (!is_done) {
      const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start;
      seen.emplace_back(elapsed.count(), progress.fraction());
      std::this_thread::sleep_for(std::chrono::milliseconds(2));
    }
  });
  static_cast<void>(
      simplify::simplify(Mesh(mesh), {.target_faces = 50'000, .progress = &progress}));
  is_done = true;
  watcher.join();
  double most = 0.0;
  for (const auto& [seconds, fraction] : seen)
    most = std::max(most, std::abs(seconds / seen.back().first - double{fraction}));
  // Loose, because other programs may run: a stage that does not report would exceed it.
  EXPECT_LT(most, 0.4);
  RecordProperty("largest_deviation", std::to_string(most));
}

TEST(Simplify, EstimatedErrorIsNearTheMeasuredDistance) {
  const Mesh mesh = bumpy_torus(120, 80);
  for (const std::uint32_t target : {4'000U, 1'000U, 300U}) {
    const simplify::Simplified result = simplify::simplify(Mesh(mesh), {.target_faces = target});
    const double measured = analysis::surface_distance(mesh, result.mesh).two_sided().rms;
    EXPECT_GT(result.report.estimated_error, 0.5 * measured);
    EXPECT_LT(result.report.estimated_error, 2.0 * measured);
  }
}

}  // namespace
}  // namespace mesher::test
