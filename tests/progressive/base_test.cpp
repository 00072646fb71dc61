#include "engine/progressive/base.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <iostream>
#include <string>

#include "engine/io/read.h"
#include "engine/progressive/build.h"
#include "tests/progressive/checks.h"
#include "tests/support/meshes.h"
#include "tests/support/obj_files.h"

namespace mesher::test {
namespace {

progressive::Progressive with_chosen_base(const Mesh& mesh) {
  simplify::SimplifyOptions options;
  progressive::choose_base(options, mesh.face_count(), statistics(mesh).box.diagonal());
  return progressive::make_progressive(mesh, options);
}

TEST(ChooseBase, IsTwoHundredFacesOrAnEighth) {
  const auto chosen = [](std::uint32_t faces) {
    simplify::SimplifyOptions options;
    progressive::choose_base(options, faces, 10.0);
    EXPECT_DOUBLE_EQ(options.stop_before_error, 0.5);
    return options;
  };
  EXPECT_EQ(chosen(70'000).target_faces, 200U);
  EXPECT_EQ(chosen(1'600).target_faces, 200U);
  EXPECT_EQ(chosen(1'000).target_faces, 125U);
  EXPECT_EQ(chosen(1'000).stop_below_faces, 250U);
  EXPECT_EQ(chosen(12).target_faces, 1U);
  EXPECT_EQ(chosen(12).stop_below_faces, 3U);
  EXPECT_EQ(chosen(0).target_faces, 1U);
  simplify::SimplifyOptions with_seams;
  progressive::choose_base(with_seams, 70'000, 10.0, true);
  EXPECT_DOUBLE_EQ(with_seams.stop_before_error, 0.05);
  EXPECT_EQ(with_seams.target_faces, 200U);
}

TEST(ChooseBase, LeavesSplitsInSmallModels) {
  for (const char* name : {"cube.obj", "cactus.obj", "bunny_200.obj", "bunny_1k.obj",
                           "open_box.obj", "hypersheet.obj"}) {
    const Mesh mesh =
        io::read_model(std::filesystem::path(MESHER_SOURCE_DIR "/assets") / name).mesh;
    progressive::Progressive made = with_chosen_base(mesh);
    EXPECT_LE(3 * made.mesh.base_face_count(), mesh.face_count()) << name;
    EXPECT_EQ(made.report.faces_reached, made.mesh.base_face_count()) << name;
    examine_levels(made.mesh, 8);
  }
}

/// Many separate boxes: the error of a collapse exceeds the limit long before an eighth of the
/// faces is reached.
TEST(ChooseBase, StopsBeforeTheErrorIsTooLarge) {
  Soup soup = cube();
  for (glm::vec3& p : soup.positions)
    p.z *= 3.0F;
  Mesh mesh = built(join(soup, cube(), {2.0F, 0.0F, 1.0F})).mesh;
  progressive::Progressive made = with_chosen_base(mesh);
  EXPECT_LT(made.mesh.base_face_count(), mesh.face_count());
  EXPECT_GE(4 * made.mesh.base_face_count(), mesh.face_count());

  for (const std::filesystem::path& file : files_in(MESHER_SOURCE_DIR "/assets")) {
    const Mesh input = io::read_model(file).mesh;
    const progressive::Progressive base = with_chosen_base(input);
    const double limit = simplify::kFarFromInput * statistics(input).box.diagonal();
    if (4 * base.mesh.base_face_count() < input.face_count()) {
      EXPECT_LE(base.report.estimated_error, limit) << file;
    }
  }
}

class SharedBases : public testing::TestWithParam<const char*> {};

TEST_P(SharedBases, AreAccurateAndMuchSmallerThanTheModel) {
  const auto file =
      std::filesystem::path(MESHER_SHARED_MODELS) / (std::string(GetParam()) + ".obj");
  if (!std::filesystem::exists(file)) GTEST_SKIP() << "SKIPPED: no shared model " << file;
  const Mesh mesh = io::read_model(file).mesh;
  const progressive::Progressive made = with_chosen_base(mesh);
  EXPECT_LE(made.mesh.base_face_count(), 200U);
  EXPECT_LE(5 * made.mesh.base_face_count(), mesh.face_count());
  EXPECT_LE(made.report.estimated_error, simplify::kFarFromInput * statistics(mesh).box.diagonal());
}

INSTANTIATE_TEST_SUITE_P(Shared, SharedBases,
                         testing::Values("beast", "horse", "cessna", "teapot", "cactus", "suzanne",
                                         "spot", "fandisk", "rocker-arm"));

}  // namespace
}  // namespace mesher::test
