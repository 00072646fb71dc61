#include <gtest/gtest.h>
#include <mesher/error.h>
#include <mesher/render.h>

#include <algorithm>
#include <string>

#include "engine/io/png.h"
#include "tests/support/process.h"
#include "tests/support/temp_folder.h"

namespace mesher {
namespace {

const std::string kSmallBunny = MESHER_SOURCE_DIR "/assets/bunny_1k.obj";

TEST(Renderer, PictureIsThatOfTheProgram) {
  const test::TempFolder folder;
  const auto file = folder / "p.png";
  const test::Finished run = test::run_program({MESHER_PROGRAM, "render", kSmallBunny, "-o", file,
                                                "--size", "160x120", "--gouraud", "--wireframe",
                                                "--camera", "40,20,1.5", "--supersample", "2"});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  Renderer renderer;
  EXPECT_FALSE(renderer.device().empty());
  const Picture picture = renderer.render(Asset::load(kSmallBunny), {.width = 160,
                                                                     .height = 120,
                                                                     .shading = Shading::gouraud,
                                                                     .wireframe = true,
                                                                     .yaw_deg = 40.0,
                                                                     .pitch_deg = 20.0,
                                                                     .zoom = 1.5,
                                                                     .supersample = 2});
  EXPECT_TRUE(picture.problems.empty());
  EXPECT_TRUE(std::ranges::equal(picture.rgba, io::read_png(file).rgba));
  picture.save(folder / "q.png");
  EXPECT_TRUE(std::ranges::equal(picture.rgba, io::read_png(folder / "q.png").rgba));
}

TEST(Renderer, RefusesOptionsOutOfRange) {
  Renderer renderer;
  const Asset bunny = Asset::load(kSmallBunny);
  EXPECT_THROW(renderer.render(bunny, {.width = 0}), UsageError);
  EXPECT_THROW(renderer.render(bunny, {.zoom = 0.0}), UsageError);
  EXPECT_THROW(renderer.render(bunny, {.supersample = 4}), UsageError);
  EXPECT_THROW(renderer.render(Asset()), InputError);
  EXPECT_THROW(Renderer("no such device"), DeviceError);
}

}  // namespace
}  // namespace mesher
