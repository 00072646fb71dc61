#include "app/files/turntable.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "app/document/session.h"
#include "app/viewer/scripted_session.h"
#include "engine/core/error.h"
#include "engine/io/png.h"
#include "tests/support/meshes.h"
#include "tests/support/small_disk.h"
#include "tests/support/temp_folder.h"
#include "tests/support/webp_file.h"

namespace mesher::app {
namespace {

class TurntableTest : public testing::Test {
 protected:
  TurntableTest() {
    session_.view.window = {100, 80};
    set_default_view(session_.view.camera);
    Model model;
    model.name = "torus.obj";
    model.mesh = build_mesh(test::torus(20, 10)).mesh;
    show_model(session_, std::move(model), "torus.obj");
  }
  void TearDown() override { script_.expect_no_messages(); }

  test::TempFolder folder_;
  Session session_;
  ScriptedSession script_{session_, {.device = "", .validation = true}};
};

TEST_F(TurntableTest, FullDiskLeavesNoFrame) {
  const test::SmallDisk disk(1U << 14);
  for (const char* name : {"turn_##.png", "turn.webp"}) {
    try {
      write_turntable(script_.scene(), {.scale = 4}, {.frames = 20, .seconds = 1.0F}, disk / name,
                      nullptr);
      ADD_FAILURE() << name;
    } catch (const OutputError& error) {
      EXPECT_TRUE(std::string(error.what()).ends_with("No space left on device")) << error.what();
    }
    EXPECT_EQ(disk.count_files(), 0U);
  }
}

TEST(Turn, ClosesWithoutAJump) {
  render::Camera start;
  start.set_angles(0.3, 0.2);
  constexpr std::uint32_t kFrames = 7;
  const double step = 2.0 * std::numbers::pi / kFrames;
  EXPECT_EQ(turned(start, 0, kFrames), start);
  for (std::uint32_t frame = 0; frame < kFrames; ++frame) {
    const render::Camera now = turned(start, frame, kFrames);
    const render::Camera next = turned(start, (frame + 1) % kFrames, kFrames);
    EXPECT_NEAR(std::remainder(next.yaw_rad() - now.yaw_rad() - step, 2.0 * std::numbers::pi), 0.0,
                1e-12);
    EXPECT_EQ(next.pitch_rad(), start.pitch_rad());
    EXPECT_EQ(next.distance(), start.distance());
  }
}

TEST(Turn, ShowsTheWholeModelInEveryFrame) {
  const Box box{glm::vec3(-10.0F, -1.0F, -1.0F), glm::vec3(10.0F, 1.0F, 1.0F)};
  constexpr double kAspect = 1.5;
  for (const bool is_orthographic : {false, true}) {
    render::Camera end_on;  // looks along the longest side
    end_on.set_angles(0.5 * std::numbers::pi, 0.1);
    end_on.set_orthographic(is_orthographic);
    end_on.frame(box, kAspect);
    const render::Camera start = turn_start(end_on, box, kAspect, 36);
    bool is_cut_without = false;
    for (std::uint32_t frame = 0; frame < 36; ++frame) {
      const auto is_inside = [&](const render::Camera& camera) {
        const render::ViewTransform view = camera.transform(kAspect, box);
        for (int i = 0; i < 8; ++i) {
          const glm::vec4 clip =
              view.clip({(i & 1) != 0 ? box.min.x : box.max.x, (i & 2) != 0 ? box.min.y : box.max.y,
                         (i & 4) != 0 ? box.min.z : box.max.z});
          if (std::abs(clip.x) > clip.w || std::abs(clip.y) > clip.w) return false;
        }
        return true;
      };
      EXPECT_TRUE(is_inside(turned(start, frame, 36))) << frame;
      is_cut_without |= !is_inside(turned(end_on, frame, 36));
    }
    EXPECT_TRUE(is_cut_without);
  }
}

TEST(Turn, KeepsACameraThatLooksElsewhere) {
  const Box box{glm::vec3(-10.0F, -1.0F, -1.0F), glm::vec3(10.0F, 1.0F, 1.0F)};
  render::Camera camera;
  camera.recenter({3.0, 0.0, 0.0});
  EXPECT_EQ(turn_start(camera, box, 1.0, 36), camera);
}

TEST(FrameFile, HasTheNumberOfTheFrame) {
  EXPECT_EQ(frame_file("a/turn_###.png", 7), "a/turn_007.png");
  EXPECT_EQ(frame_file("#.png", 12), "12.png");
  EXPECT_EQ(frame_file("a#b#.png", 3), "a3b#.png");
  EXPECT_EQ(frame_file("f#/##.png", 1), "f#/01.png");
}

TEST(TurntableObjection, NamesAFormatForManyFrames) {
  EXPECT_EQ(turntable_objection("a.webp", {800, 600}, {}, {}), "");
  EXPECT_EQ(turntable_objection("a_###.png", {800, 600}, {}, {}), "");
  EXPECT_NE(turntable_objection("a.png", {800, 600}, {}, {}), "");
  EXPECT_NE(turntable_objection("f_#/a.png", {800, 600}, {}, {}), "");
  EXPECT_NE(turntable_objection("a_##.webp", {800, 600}, {}, {}), "");
  EXPECT_NE(turntable_objection("a.gif", {800, 600}, {}, {}), "");
  EXPECT_NE(turntable_objection("a.webp", {3000, 600}, {.scale = 8}, {}), "");
}

TEST(TurntableObjection, AnimationsHaveAtMost60FramesPerSecond) {
  EXPECT_EQ(turntable_objection("a.webp", {80, 60}, {}, {.frames = 60, .seconds = 1.0F}), "");
  EXPECT_NE(turntable_objection("a.webp", {80, 60}, {}, {.frames = 61, .seconds = 1.0F}), "");
  EXPECT_EQ(turntable_objection("#.png", {80, 60}, {}, {.frames = 61, .seconds = 1.0F}), "");
}

TEST_F(TurntableTest, FramesShowTheModelFromAllSides) {
  const TurntableOptions turn{.frames = 6, .seconds = 1.0F};
  write_turntable(script_.scene(), {.scale = 2}, turn, folder_ / "t_##.png", nullptr);
  EXPECT_EQ(folder_.count_files(), 6U);
  const PictureScene scene = script_.scene();
  PictureScene third = scene;
  third.camera = turned(turn_start(scene.camera, scene.box, 1.25, 6), 3, 6);
  EXPECT_EQ(io::read_png(folder_ / "t_03.png").rgba,
            draw_picture(third, {.scale = 2}, nullptr).rgba);
  EXPECT_NE(io::read_png(folder_ / "t_00.png").rgba, io::read_png(folder_ / "t_03.png").rgba);
}

TEST_F(TurntableTest, AnimationHasTheFramesAndTheDuration) {
  const TurntableOptions turn{.frames = 7, .seconds = 1.0F};
  for (const bool is_transparent : {false, true}) {
    const PictureOptions options{.is_transparent = is_transparent};
    write_turntable(script_.scene(), options, turn, folder_ / "t.webp", nullptr);
    write_turntable(script_.scene(), options, turn, folder_ / "t#.png", nullptr);
    const test::WebpFile animation = test::read_webp(folder_ / "t.webp");
    EXPECT_EQ(animation.loops, 0U);
    EXPECT_EQ(animation.ends_ms, (std::vector<std::uint32_t>{143, 286, 429, 571, 714, 857, 1000}));
    ASSERT_EQ(animation.frames.size(), 7U);
    for (std::uint32_t frame = 0; frame < 7; ++frame) {
      const Image png = io::read_png(frame_file(folder_ / "t#.png", frame));
      double sum = 0.0;
      for (std::size_t i = 0; i < png.rgba.size(); ++i) {
        // The color of an invisible pixel is arbitrary.
        if (png.rgba[i - i % 4 + 3] > 0)
          sum += std::abs(int{png.rgba[i]} - int{animation.frames[frame].rgba[i]});
      }
      EXPECT_LT(sum / static_cast<double>(png.rgba.size()), 3.0) << frame;
      EXPECT_EQ(animation.frames[frame].pixel(0, 0)[3], is_transparent ? 0 : 255);
    }
  }
}

TEST_F(TurntableTest, CancelledTurnLeavesNoFile) {
  for (const char* name : {"t.webp", "t_##.png"}) {
    Progress progress;
    progress.cancel();
    EXPECT_THROW(write_turntable(script_.scene(), {}, {.frames = 5}, folder_ / name, &progress),
                 Cancelled);
  }
  EXPECT_EQ(folder_.count_files(), 0U);
}

TEST_F(TurntableTest, AllFramesAppearOrNone) {
  std::filesystem::create_directory(folder_ / "t_3.png");
  EXPECT_THROW(check_turntable_files(folder_ / "t_#.png", {.frames = 5}), OutputError);
  EXPECT_NO_THROW(check_turntable_files(folder_ / "t_#.png", {.frames = 3}));
  EXPECT_THROW(write_turntable(script_.scene(), {}, {.frames = 5}, folder_ / "t_#.png", nullptr),
               OutputError);
  EXPECT_FALSE(std::filesystem::exists(folder_ / "t_0.png"));
}

TEST_F(TurntableTest, ReportsItsProgress) {
  Progress progress;
  write_turntable(script_.scene(), {}, {.frames = 3}, folder_ / "t.webp", &progress);
  EXPECT_EQ(progress.fraction(), 1.0F);
  EXPECT_EQ(progress.stage(), "drawing the turn");
}

}  // namespace
}  // namespace mesher::app
