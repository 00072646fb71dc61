#include "app/files/picture_task.h"

#include <gtest/gtest.h>

#include "app/document/session.h"
#include "app/edit/edits.h"
#include "app/input/commands.h"
#include "app/viewer/scripted_session.h"
#include "engine/core/error.h"
#include "engine/core/job.h"
#include "engine/gpu/result.h"
#include "engine/io/png.h"
#include "engine/io/read.h"
#include "tests/support/assets.h"
#include "tests/support/fault_layer.h"
#include "tests/support/gltf_scene_file.h"
#include "tests/support/temp_folder.h"
#include "tests/support/webp_file.h"

namespace mesher::app {
namespace {

class PictureTaskTest : public testing::Test {
 protected:
  PictureTaskTest() {
    session_.view.window = {120, 90};
    set_default_view(session_.view.camera);
    Model model;
    model.name = "bunny.obj";
    model.mesh = test::asset("bunny.obj");
    show_model(session_, std::move(model), "bunny.obj");
  }
  PictureTask task(const PictureRequest& request) {
    PictureTask task = begin_picture(session_.document, session_.view, request);
    task.validation = true;
    return task;
  }
  Image drawn(const PictureOptions& options = {}) {
    PictureTask begun = task({.file = folder_ / "a.png", .options = options});
    perform(begun, nullptr);
    return io::read_png(folder_ / "a.png");
  }

  test::TempFolder folder_;
  Session session_;
  ScriptedSession script_{session_, {.device = "", .validation = true}};
};

TEST_F(PictureTaskTest, DrawsWhatTheWindowShows) {
  EXPECT_EQ(drawn().rgba, script_.picture().rgba);
  for (const char* keys : {"w", "shift+w", "g", "c ctrl+a", "d", "s l"}) {
    script_.press(parse_keys(keys));
    EXPECT_EQ(drawn().rgba, script_.picture().rgba) << keys;
  }
}

TEST_F(PictureTaskTest, DrawsScenesWithTheirMaterials) {
  show_model(session_,
             io::read_model(folder_.write("s.gltf", test::scene_file()), {.keeps_scene = true}),
             "s.gltf");
  session_.view.settings.look = render::Look::base_color;
  const Image whole = drawn();
  EXPECT_EQ(whole.rgba, script_.picture().rgba);
  session_.document.hidden = {false, true, false, false, false};
  const Image hidden = drawn();
  EXPECT_NE(hidden.rgba, whole.rgba);
  EXPECT_EQ(hidden.rgba, script_.picture().rgba);
  session_.document.hidden.clear();
  session_.document.playback = {.animation = 0, .time_s = 0.5};
  const Image turned = drawn();
  EXPECT_NE(turned.rgba, whole.rgba);
  EXPECT_EQ(turned.rgba, script_.picture().rgba);
}

TEST_F(PictureTaskTest, DrawsLevelsWithTheirColors) {
  Model model;
  model.mesh = test::asset("bunny_1k.obj");
  AttributeLayer colors(color_type(), model.mesh.vertex_count());
  for (std::uint32_t v = 0; v < model.mesh.vertex_count(); ++v)
    store(colors, v, {1.0, v % 2 == 0 ? 0.0 : 0.5, 0.0, 1.0});
  model.attributes.layers.push_back(std::move(colors));
  show_model(session_, std::move(model), "colored.ply");
  session_.view.settings.look = render::Look::base_color;
  script_.press(parse_keys("p pagedown pagedown"));
  const Image level = drawn();
  EXPECT_EQ(level.rgba, script_.picture().rgba);
  // Nothing on the model has blue; clay would.
  const std::uint8_t* const middle = level.pixel(60, 50);
  EXPECT_GT(middle[0], 200);
  EXPECT_EQ(middle[2], 0);
}

TEST_F(PictureTaskTest, LostGpuLeavesNoFile) {
  const test::FaultLayer faults;
  const std::vector<std::string> variables = faults.environment();
  for (const std::string& variable : variables) {
    const std::size_t equals = variable.find('=');
    setenv(variable.substr(0, equals).c_str(), variable.substr(equals + 1).c_str(), 1);
  }
  for (const char* name : {"a.png", "a.webp"}) {
    faults.cue({{"vkQueueSubmit2", VK_ERROR_DEVICE_LOST}});
    PictureTask lost = task({.file = folder_ / name, .options = {}});
    EXPECT_THROW(perform(lost, nullptr), gpu::LostError);
    EXPECT_TRUE(faults.is_over());
    EXPECT_EQ(folder_.count_files(), 0U);
  }
  for (const std::string& variable : variables)
    unsetenv(variable.substr(0, variable.find('=')).c_str());
}

TEST_F(PictureTaskTest, DrawsGeomorphs) {
  script_.press(parse_keys("p home pageup pageup shift+b g"));
  EXPECT_EQ(drawn().rgba, script_.picture().rgba);
}

TEST_F(PictureTaskTest, ShowsThePartBesideThePanels) {
  session_.view.insets = {.left = 40, .top = 0, .right = 0, .bottom = 30};
  const Image picture = drawn({.scale = 2});
  EXPECT_EQ(picture.width, 160U);
  EXPECT_EQ(picture.height, 120U);
}

TEST_F(PictureTaskTest, RunsOnAnotherThreadWhileTheModelChanges) {
  const Image before = script_.picture();
  auto begun = std::make_shared<PictureTask>(task({.file = folder_ / "a.png"}));
  JobOf<std::filesystem::path> job(
      "Drawing",
      [begun](Progress& progress) {
        perform(*begun, &progress);
        return begun->request.file;
      },
      nullptr);
  script_.press(parse_keys("d d d"));
  job.wait();
  EXPECT_EQ(job.take(), folder_ / "a.png");
  EXPECT_EQ(io::read_png(folder_ / "a.png").rgba, before.rgba);
}

TEST_F(PictureTaskTest, WritesATurn) {
  PictureTask begun =
      task({.file = folder_ / "t.webp", .options = {}, .turn = TurntableOptions{.frames = 4}});
  perform(begun, nullptr);
  EXPECT_EQ(test::read_webp(folder_ / "t.webp").frames.size(), 4U);
}

TEST_F(PictureTaskTest, CancelledTaskLeavesNoFile) {
  PictureTask begun =
      task({.file = folder_ / "t.webp", .options = {}, .turn = TurntableOptions{.frames = 4}});
  Progress progress;
  progress.cancel();
  EXPECT_THROW(perform(begun, &progress), Cancelled);
  EXPECT_EQ(folder_.count_files(), 0U);
}

TEST_F(PictureTaskTest, ObjectionDependsOnTheTurnAndTheView) {
  PictureRequest request{.file = "a.png", .options = {.scale = 8}};
  EXPECT_EQ(objection(request, session_.view), "");
  session_.view.window = {5000, 90};
  EXPECT_NE(objection(request, session_.view), "");
  request.options.scale = 1;
  EXPECT_EQ(objection(request, session_.view), "");
  request.turn = TurntableOptions{};
  EXPECT_NE(objection(request, session_.view), "") << "a .png holds one picture";
}

}  // namespace
}  // namespace mesher::app
