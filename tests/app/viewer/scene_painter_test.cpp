// Tests what a window draws of a scene that takes longer than a frame. The test sets the clock.
#include "app/viewer/scene_painter.h"

#include <gtest/gtest.h>

#include <memory>
#include <optional>
#include <utility>

#include "app/document/shown.h"
#include "app/document/stand_in.h"
#include "engine/gpu/device_image.h"
#include "engine/mesh/build/build.h"
#include "engine/render/offscreen.h"
#include "tests/support/gpu_test.h"
#include "tests/support/meshes.h"

namespace mesher::app {
namespace {

class ScenePainterTest : public test::GpuTest {
 protected:
  static constexpr VkExtent2D kExtent{160, 120};

  ScenePainterTest() {
    Model model;
    model.mesh = build_mesh(test::torus(200, 140)).mesh;
    const Statistics stats = statistics(model.mesh);
    replace_model(document_, std::move(model), stats, "torus.obj");
    document_.opening = 1;
    camera_.set_angles(0.5, 0.4);
    camera_.frame(stats.box, double{kExtent.width} / kExtent.height);
  }

  void TearDown() override {
    painter_.reset();
    mirror_.reset();
    GpuTest::TearDown();
  }

  /// Shows a progressive mesh of the model, with a cube as its stand-in.
  void show_levels() {
    DetailLevels levels = detail_levels(
        progressive::make_progressive(document_.model.mesh, {.target_faces = 200}), nullptr);
    levels.stand_in = std::make_shared<const Mesh>(cube());
    document_.progressive.show(std::move(levels));
    document_.progressive.turn(true);
  }
  static Mesh cube() { return build_mesh(test::cube()).mesh; }

  /// Draws the next frame, a second after the one before. Returns whether more are needed.
  bool frame() {
    now_s_ += 1.0;
    if (mirror_->update(document_, {})) painter_->invalidate();
    bool needs_more = false;
    device().run_once([&](VkCommandBuffer commands) {
      needs_more = painter_->draw(commands, kExtent, *mirror_, document_, camera_, now_s_);
    });
    return needs_more;
  }
  bool turn_and_draw() {
    camera_.set_angles(camera_.yaw_rad() + 0.01, camera_.pitch_rad());
    return frame();
  }
  /// Turns the camera until the painter has noticed how slow it is.
  void turn_until_heavy() {
    for (int i = 0; i < 20 && (i == 0 || painter_->is_finished()); ++i)
      turn_and_draw();
    ASSERT_FALSE(painter_->is_finished());
  }
  void draw_to_the_end() {
    int frames = 1;
    for (; frame(); ++frames)
      ASSERT_LT(frames, 1000) << "the window never sleeps";
    ASSERT_TRUE(painter_->is_finished());
  }

  Image shown() {
    return gpu::read_image(device(), painter_->image().color(), gpu::kTransferSource);
  }
  Image whole() {
    return render::render_image(device(), painter_->renderer(), mirror_->mesh(), camera_,
                                mirror_->settings(), kExtent.width, kExtent.height);
  }
  Image drawn_quickly(Mesh mesh) {
    render::Settings settings;
    settings.samples = 1;
    settings.back = settings.front;
    return render::render_image(device(), mesh, camera_, settings, kExtent.width, kExtent.height);
  }

  Document document_;
  render::Camera camera_;
  std::optional<SceneMirror> mirror_{std::in_place, device()};
  std::optional<ScenePainter> painter_{std::in_place, device(), VK_FORMAT_R8G8B8A8_UNORM};
  double now_s_ = 0.0;
};

TEST_F(ScenePainterTest, HeavyModelIsDrawnCoarselyWhileTheCameraMoves) {
  document_.stand_in = std::make_shared<const Mesh>(cube());
  turn_until_heavy();
  EXPECT_EQ(shown().rgba, drawn_quickly(cube()).rgba);
  draw_to_the_end();
  EXPECT_EQ(shown().rgba, whole().rgba);
}

TEST_F(ScenePainterTest, LevelIsDrawnCoarselyWhileTheCameraMoves) {
  show_levels();
  turn_until_heavy();
  EXPECT_EQ(shown().rgba, drawn_quickly(cube()).rgba);
  draw_to_the_end();
  EXPECT_EQ(shown().rgba, whole().rgba);
}

TEST_F(ScenePainterTest, InputInterruptsTheRefinementOfALevel) {
  show_levels();
  turn_until_heavy();
  EXPECT_TRUE(frame());
  EXPECT_FALSE(painter_->is_finished());
  turn_and_draw();
  EXPECT_EQ(shown().rgba, drawn_quickly(cube()).rgba);
  draw_to_the_end();
  EXPECT_EQ(shown().rgba, whole().rgba);
}

TEST_F(ScenePainterTest, SlicesShowUnfinishedSplits) {
  show_levels();
  turn_until_heavy();
  document_.progressive.move_to(0.95);
  EXPECT_LT(document_.progressive.growth().fixed, 1.0F);
  frame();
  EXPECT_FALSE(painter_->is_finished());
  draw_to_the_end();
  EXPECT_EQ(shown().rgba, whole().rgba);
}

TEST_F(ScenePainterTest, LevelStandsInForTheModelItself) {
  document_.stand_in = std::make_shared<const Mesh>(build_mesh(test::tetrahedron()).mesh);
  turn_until_heavy();
  show_levels();
  document_.progressive.turn(false);
  turn_and_draw();
  EXPECT_EQ(shown().rgba, drawn_quickly(cube()).rgba);
  document_.progressive.forget();
  turn_and_draw();
  EXPECT_EQ(shown().rgba, drawn_quickly(build_mesh(test::tetrahedron()).mesh).rgba);
}

TEST_F(ScenePainterTest, LightModelIsDrawnWhole) {
  frame();
  EXPECT_TRUE(painter_->is_finished());
  turn_and_draw();
  EXPECT_TRUE(painter_->is_finished());
  frame();  // the first one without changes is antialiased
  EXPECT_EQ(shown().rgba, whole().rgba);
}

}  // namespace
}  // namespace mesher::app
