#include "app/files/picture.h"

#include <gtest/gtest.h>

#include "app/document/session.h"
#include "app/viewer/scripted_session.h"
#include "engine/core/error.h"
#include "engine/io/png.h"
#include "tests/support/meshes.h"
#include "tests/support/temp_folder.h"
#include "tests/support/webp_file.h"

namespace mesher::app {
namespace {

class PictureFileTest : public testing::Test {
 protected:
  PictureFileTest() {
    session_.view.window = {120, 90};
    set_default_view(session_.view.camera);
    Model model;
    model.name = "cube.obj";
    model.mesh = build_mesh(test::cube()).mesh;
    show_model(session_, std::move(model), "cube.obj");
  }
  void TearDown() override { script_.expect_no_messages(); }

  test::TempFolder folder_;
  Session session_;
  ScriptedSession script_{session_, {.device = "", .validation = true}};
};

TEST(PictureObjection, NamesEndInAFormat) {
  for (const char* name : {"a.png", "a.PNG", "a.webp", "folder/a.b.WebP"})
    EXPECT_EQ(picture_objection(name, {800, 600}, {}), "") << name;
  for (const char* name : {"a.jpg", "a", "", "png", "a.png.txt"})
    EXPECT_NE(picture_objection(name, {800, 600}, {}), "") << name;
}

TEST(PictureObjection, SizesHaveLimits) {
  EXPECT_EQ(picture_objection("a.png", {3840, 2160}, {.scale = 8}), "");
  EXPECT_EQ(picture_objection("a.png", {3840, 2160}, {.scale = 8, .supersample = 2}), "");
  EXPECT_NE(picture_objection("a.png", {3840, 2160}, {.scale = 8, .supersample = 3}), "");
  EXPECT_EQ(picture_objection("a.png", {600, 4096}, {.scale = 8}), "");
  EXPECT_NE(picture_objection("a.png", {600, 4097}, {.scale = 8}), "");
  EXPECT_EQ(picture_objection("a.webp", {16'383, 2}, {}), "");
  EXPECT_NE(picture_objection("a.webp", {16'384, 2}, {}), "");
  EXPECT_EQ(picture_objection("a.png", {16'384, 2}, {}), "");
}

TEST_F(PictureFileTest, PngAndWebpHoldTheSamePixels) {
  for (const PictureOptions& options :
       {PictureOptions{}, {.scale = 3}, {.supersample = 2, .is_transparent = true}}) {
    write_picture(script_.scene(), options, folder_ / "a.png", nullptr);
    write_picture(script_.scene(), options, folder_ / "a.webp", nullptr);
    const Image png = io::read_png(folder_ / "a.png");
    EXPECT_EQ(png.width, 120 * options.scale);
    EXPECT_EQ(png.height, 90 * options.scale);
    const test::WebpFile webp = test::read_webp(folder_ / "a.webp");
    ASSERT_EQ(webp.frames.size(), 1U);
    EXPECT_EQ(webp.frames[0].rgba, png.rgba);
  }
}

TEST_F(PictureFileTest, OfDefaultOptionsEqualsTheScreenshot) {
  write_picture(script_.scene(), {}, folder_ / "a.png", nullptr);
  EXPECT_EQ(io::read_png(folder_ / "a.png").rgba, script_.picture().rgba);
}

TEST_F(PictureFileTest, LinesCanBeLeftOut) {
  const Image surface = draw_picture(script_.scene(), {}, nullptr);
  session_.view.settings.wireframe = true;
  const Image lines = draw_picture(script_.scene(), {}, nullptr);
  EXPECT_NE(lines.rgba, surface.rgba);
  EXPECT_EQ(draw_picture(script_.scene(), {.has_lines = false}, nullptr).rgba, surface.rgba);
  session_.view.settings.shading = render::Shading::none;
  const Image alone = draw_picture(script_.scene(), {}, nullptr);
  EXPECT_EQ(draw_picture(script_.scene(), {.has_lines = false}, nullptr).rgba, alone.rgba);
}

TEST_F(PictureFileTest, LegendLiesOverTheSamePicture) {
  session_.view.window = {400, 300};
  session_.view.settings.wireframe = true;
  session_.document.statistics.crease_edges = 12;
  for (const PictureOptions& options : {PictureOptions{.has_legend = true},
                                        {.scale = 2, .is_transparent = true, .has_legend = true}}) {
    PictureScene scene = script_.scene();
    const Image plain = draw_picture(scene, options, nullptr);
    scene.legend =
        legend_of_picture(scene.settings, legend_facts(session_.document), scene.window, options);
    ASSERT_EQ(scene.legend.width, 216 * options.scale);
    const Image image = draw_picture(scene, options, nullptr);
    EXPECT_NE(image.rgba, plain.rgba);
    EXPECT_EQ(image.pixel(image.width - 1, 0)[0], plain.pixel(image.width - 1, 0)[0]);
    write_picture(scene, options, folder_ / "a.png", nullptr);
    EXPECT_EQ(io::read_png(folder_ / "a.png").rgba, image.rgba) << "in bands of rows";
  }
  const auto legend = [&](const PictureOptions& options) {
    const PictureScene scene = script_.scene();
    return legend_of_picture(scene.settings, legend_facts(session_.document), scene.window,
                             options);
  };
  EXPECT_EQ(legend({}).width, 0U) << "nobody asked";
  EXPECT_EQ(legend({.has_lines = false, .has_legend = true}).width, 0U) << "there are no lines";
}

TEST_F(PictureFileTest, FailureKeepsTheOldFile) {
  folder_.write("a.png", "old");
  folder_.write("a.webp", "old");
  Progress progress;
  progress.cancel();
  for (const char* name : {"a.png", "a.webp"}) {
    EXPECT_THROW(write_picture(script_.scene(), {}, folder_ / name, &progress), Cancelled);
    EXPECT_EQ(test::read_bytes(folder_ / name), "old");
  }
  EXPECT_EQ(folder_.count_files(), 2U);
  EXPECT_THROW(write_picture(script_.scene(), {}, "/dev/full", nullptr), OutputError);
  EXPECT_THROW(write_picture(script_.scene(), {}, folder_ / "missing/a.png", nullptr), OutputError);
}

}  // namespace
}  // namespace mesher::app
