// Every policy on every model, down to a thousandth of its faces: checks that hold for any model.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <iostream>
#include <string>

#include "engine/core/parallel.h"
#include "engine/io/read.h"
#include "engine/simplify/simplify.h"
#include "tests/simplify/replay.h"
#include "tests/support/meshes.h"
#include "tests/support/obj_files.h"
#include "tests/support/sanitized.h"

namespace mesher::test {
namespace {

constexpr double kRatios[] = {0.5, 0.1, 0.01, 0.001};
// Up to this size the test checks every collapse of every run. For larger models it checks the
// result.
constexpr std::uint32_t kSmallModel = kSanitized ? 400 : 1'300;
// Under the sanitizers, larger models are simplified to one size only.
constexpr std::uint32_t kLargeModel = 20'000;

void examine_run(const Mesh& mesh, simplify::CostPolicy policy, double ratio) {
  SCOPED_TRACE(std::string(key(policy)) + " to " + std::to_string(ratio));
  const auto target = static_cast<std::uint32_t>(std::lround(ratio * mesh.face_count()));
  simplify::CollapseRecorder recorder;
  const simplify::Simplified result = simplify::simplify(
      Mesh(mesh), {.target_faces = std::max(target, 1U), .cost = policy, .observer = &recorder});
  const simplify::SimplifyReport& report = result.report;
  expect_valid(result.mesh);
  EXPECT_EQ(topology(result.mesh), topology(mesh));
  expect_no_harmful_folds(mesh, result.mesh, policy);
  EXPECT_EQ(report.faces_reached, result.mesh.face_count());
  EXPECT_EQ(report.collapses, recorder.records().size());
  EXPECT_EQ(report.vertices_reached + report.collapses, report.vertices_before);
  if (report.reason == simplify::StopReason::target_reached) {
    // A closed mesh loses two faces per collapse.
    EXPECT_LE(report.faces_reached, report.faces_asked);
    EXPECT_LE(report.faces_asked - report.faces_reached, 1U);
  } else {
    EXPECT_EQ(report.reason, simplify::StopReason::no_legal_collapse);
    EXPECT_GT(report.faces_reached, report.faces_asked);
  }
  if (mesh.face_count() > kSmallModel) return;
  const Topology before = topology(mesh);
  const Mesh replayed = replay(Mesh(mesh), recorder.records(), [&](const Mesh& step, std::size_t) {
    expect_valid(step);
    EXPECT_EQ(topology(step), before);
  });
  EXPECT_TRUE(is_same_surface(replayed, result.mesh));
}

void examine(const std::filesystem::path& file) {
  SCOPED_TRACE(file.filename().string());
  const Mesh mesh = io::read_model(file, {}).mesh;
  for (std::size_t p = 0; p < simplify::kCostPolicies.size(); ++p) {
    for (const double ratio : kRatios) {
      if (kSanitized && mesh.face_count() > kLargeModel && ratio != 0.01) continue;
      examine_run(mesh, static_cast<simplify::CostPolicy>(p), ratio);
      if (testing::Test::HasFailure()) return;
    }
  }
}

TEST(Models, AssetsKeepTopologyAndReachTheTarget) {
  for (const std::filesystem::path& file : files_in(MESHER_SOURCE_DIR "/assets")) {
    // The bunny of a Debian package, as large as the scans.
    if (file.stem() == "bunny_70k" || file.stem() == "bunny_40k") continue;
    examine(file);
  }
}

class Scan : public testing::TestWithParam<const char*> {};

TEST_P(Scan, KeepsTopologyAndReachesTheTarget) {
  const std::filesystem::path file =
      std::filesystem::path(MESHER_SHARED_MODELS) / (std::string(GetParam()) + ".obj");
  if (!std::filesystem::exists(file)) {
    std::cerr << "*** NOT TESTED: " << file << " is missing ***\n";
    return;
  }
  examine(file);
}

INSTANTIATE_TEST_SUITE_P(Shared, Scan,
                         testing::Values("armadillo", "bunny", "cactus", "fandisk", "spot",
                                         "suzanne", "teapot"));

}  // namespace
}  // namespace mesher::test
