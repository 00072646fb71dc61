// Simplification of meshes from broken files: a million collapse attempts over the zoo.
#include <gtest/gtest.h>

#include <iostream>
#include <random>

#include "engine/core/error.h"
#include "engine/io/read.h"
#include "engine/mesh/statistics.h"
#include "engine/simplify/simplify.h"
#include "tests/simplify/replay.h"
#include "tests/support/meshes.h"
#include "tests/support/sanitized.h"
#include "tests/support/temp_folder.h"
#include "tests/support/zoo.h"

namespace mesher::test {
namespace {

constexpr std::uint64_t kAttempts = kSanitized ? 250'000 : 1'000'000;
constexpr std::uint32_t kMostFaces = 20'000;
// A larger file has more faces. Under the sanitizers, eight large files with few faces are left
// out, too: reading them would take nearly all of the time.
constexpr std::size_t kMostBytes = kSanitized ? 1'500'000 : 20'000'000;

std::vector<Mesh> meshes_of_the_zoo() {
  std::vector<Mesh> meshes;
  const TempFolder folder;
  for (const Specimen& specimen : zoo()) {
    if (specimen.bytes.size() > kMostBytes) continue;
    const auto file = folder.write("specimen" + specimen.extension, specimen.bytes);
    try {
      Mesh mesh = io::read_model(file, {}).mesh;
      if (mesh.face_count() > 0 && mesh.face_count() <= kMostFaces)
        meshes.push_back(std::move(mesh));
    } catch (const InputError&) {
      // Rejected as expected. This test is not about the readers.
    }
  }
  // Soups of random triangles have every defect at once.
  for (std::uint32_t seed = 0; seed < 300; ++seed) {
    std::mt19937 random(seed);
    Soup soup;
    const std::uint32_t vertices = 4 + seed % 60;
    for (std::uint32_t v = 0; v < vertices; ++v)
      soup.positions.push_back({float(random() % 9), float(random() % 9), float(random() % 9)});
    for (std::uint32_t i = 0; i < 3 * (2 + 3 * (seed % 50)); ++i)
      soup.corners.push_back(static_cast<std::uint32_t>(random() % vertices));
    meshes.push_back(built(std::move(soup)).mesh);
  }
  return meshes;
}

std::uint64_t attempts(const simplify::SimplifyReport& report) {
  std::uint64_t count = report.collapses;
  for (const std::uint64_t rejected : report.rejected)
    count += rejected;
  return count;
}

TEST(Fuzz, AttemptsOverTheZooKeepMeshesValid) {
  const std::vector<Mesh> meshes = meshes_of_the_zoo();
  ASSERT_GT(meshes.size(), 320U);
  std::uint64_t tried = 0;
  std::uint64_t runs = 0;
  for (std::uint64_t seed = 1; tried < kAttempts && !testing::Test::HasFailure(); ++seed) {
    for (const Mesh& mesh : meshes) {
      // Random edges most of the time, and each of the other policies in turn.
      const auto policy =
          seed % 3 == 0
              ? static_cast<simplify::CostPolicy>(seed / 3 % simplify::kCostPolicies.size())
              : simplify::CostPolicy::random;
      const auto placement = static_cast<simplify::Placement>(seed % simplify::kPlacements.size());
      const simplify::Simplified result = simplify::simplify(
          Mesh(mesh), {.target_faces = 0, .cost = policy, .placement = placement, .seed = seed});
      expect_valid(result.mesh);
      ASSERT_EQ(topology(result.mesh), topology(mesh)) << "seed " << seed;
      // Where costs are errors, folds compete with other errors. Near the end all errors are large.
      if (policy > simplify::CostPolicy::accumulated_quadric) {
        ASSERT_LE(count_folds(result.mesh), count_folds(mesh)) << "seed " << seed;
      }
      tried += attempts(result.report);
      ++runs;
    }
  }
  std::cout << tried << " attempts in " << runs << " runs over " << meshes.size() << " meshes\n";
  EXPECT_GE(tried, kAttempts);
}

TEST(Fuzz, EveryCollapseKeepsTheMeshValid) {
  for (const Mesh& mesh : meshes_of_the_zoo()) {
    if (mesh.face_count() > (kSanitized ? 200 : 400)) continue;  // the validator makes it O(F^2)
    simplify::CollapseRecorder recorder;
    const simplify::Simplified result = simplify::simplify(
        Mesh(mesh),
        {.target_faces = 0, .cost = simplify::CostPolicy::random, .observer = &recorder});
    const Topology before = topology(mesh);
    const Mesh replayed =
        replay(Mesh(mesh), recorder.records(), [&](const Mesh& step, std::size_t) {
          expect_valid(step);
          EXPECT_EQ(topology(step), before);
        });
    ASSERT_TRUE(is_same_surface(replayed, result.mesh))
        << mesh.face_count() << " faces, " << bounding_box(mesh).diagonal() << " "
        << replayed.face_count() << " " << result.mesh.face_count();
    if (testing::Test::HasFailure()) return;
  }
}

}  // namespace
}  // namespace mesher::test
