// Compares the certified bound with dense samples, on every model and its simplified versions.
#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "engine/analysis/distance.h"
#include "engine/analysis/hausdorff.h"
#include "engine/io/read.h"
#include "engine/simplify/simplify.h"
#include "tests/support/meshes.h"
#include "tests/support/obj_files.h"

namespace mesher::test {
namespace {

void examine(const std::filesystem::path& file) {
  const Mesh mesh = io::read_model(file, {}).mesh;
  for (const double part : {0.5, 0.1, 0.01}) {
    SCOPED_TRACE(file.filename().string() + " to " + std::to_string(part));
    const auto target = static_cast<std::uint32_t>(part * mesh.face_count());
    const simplify::Simplified result =
        simplify::simplify(Mesh(mesh), {.target_faces = std::max(target, 4U), .certifies = true});
    const Mesh& after = result.mesh;
    const analysis::SurfaceDistance sampled =
        analysis::surface_distance(mesh, after, {.samples = 200'000});
    const double diagonal = bounding_box(mesh).diagonal();
    const double certified = result.report.certified_bound;
    EXPECT_GE(certified, sampled.two_sided().max - 1e-12 * diagonal);
    EXPECT_LE(certified, simplify::bound_ratio(mesh.face_count()) *
                             analysis::hausdorff_bounds(mesh, after).two_sided().upper);
    for (const double ratio : {1.1, 3.0}) {
      const analysis::HausdorffBounds bounds =
          analysis::hausdorff_bounds(mesh, after, {.ratio = ratio});
      // The samples are rounded, too.
      EXPECT_GE(bounds.forward.upper, sampled.forward.max - 1e-12 * diagonal);
      EXPECT_GE(bounds.backward.upper, sampled.backward.max - 1e-12 * diagonal);
      const auto [lower, upper] = bounds.two_sided();
      EXPECT_LE(upper, ratio * lower * (1.0 + 1e-9) + 1e-12 * diagonal);
      // Samples miss the worst point. For beast reduced to 50 % they find 0.25 of 0.32; twelve
      // million samples find 0.29.
      EXPECT_LE(lower, 1.5 * sampled.two_sided().max + 1e-12 * diagonal);
    }
  }
}

TEST(HausdorffOfModels, HoldsForEveryAsset) {
  for (const std::filesystem::path& file : files_in(MESHER_SOURCE_DIR "/assets"))
    examine(file);
}

class HausdorffOfSharedModel : public testing::TestWithParam<const char*> {};

TEST_P(HausdorffOfSharedModel, BoundsHold) {
  const auto file =
      std::filesystem::path(MESHER_SHARED_MODELS) / (std::string(GetParam()) + ".obj");
  if (!std::filesystem::exists(file)) GTEST_SKIP() << "SKIPPED: no shared model " << file;
  examine(file);
}

INSTANTIATE_TEST_SUITE_P(Shared, HausdorffOfSharedModel,
                         testing::Values("armadillo", "beast", "bunny", "cactus", "cessna",
                                         "fandisk", "horse", "rocker-arm", "spot", "suzanne",
                                         "teapot"));

}  // namespace
}  // namespace mesher::test
