// Tests progressive meshes in a real window: the mode, its panel and keys, and loading from a pipe.
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <chrono>
#include <thread>

#include "engine/io/read.h"
#include "engine/progressive/build.h"
#include "engine/progressive/codec/pm_write.h"
#include "tests/ui/window_fixture.h"
#include "tests/ui/xdnd_source.h"

namespace mesher::test {
namespace {

class ProgressiveTest : public WindowTest {
 protected:
  static std::string knot_bytes() {
    const Model model = io::read_model(MESHER_SOURCE_DIR "/assets/knot.obj");
    progressive::Progressive progressive =
        progressive::make_progressive(model.mesh, {.target_faces = 200});
    std::string bytes;
    progressive::write_pm(progressive.mesh, {}, [&](std::span<const std::byte> piece) {
      bytes.append(reinterpret_cast<const char*>(piece.data()), piece.size());
    });
    return bytes;
  }
  static json shown(const ViewerProcess& viewer) { return viewer.state()["progressive"]; }
};

TEST_F(ProgressiveTest, PEntersAndLeavesMode) {
  const auto v = open({"knot", "--size", "800x600"});
  v->key("Tab");  // without panels
  v->settle();
  const auto before = v->screenshot();
  v->key("p");
  EXPECT_REACHES(*v, s["progressive"]["on"] == true && s["progressive"]["ready"] == true);
  EXPECT_EQ(shown(*v)["faces"], 2880);
  v->key("Home");
  EXPECT_REACHES(*v, s["progressive"]["level"] == 0);
  EXPECT_LE(shown(*v)["faces"], 200);
  EXPECT_EQ(v->state()["faces"], 2880) << "the model's";
  v->settle();
  const auto coarse = v->screenshot();
  EXPECT_NE(coarse, before);
  v->key("bracketright");
  EXPECT_REACHES(*v, s["progressive"]["level"] == 1);
  v->key("comma");
  EXPECT_REACHES(*v, s["progressive"]["level"] == 0);
  v->key("Next");  // page down: the base is the coarsest level
  v->key("Prior");
  EXPECT_REACHES(*v, s["progressive"]["level"] > 1);
  v->key("d");
  EXPECT_REACHES(*v,
                 s["notice"].get<std::string>().find("K to use this level") != std::string::npos);
  v->key("Escape");
  EXPECT_REACHES(*v, s["progressive"]["on"] == false);
  v->key("d");
  EXPECT_REACHES(*v, s["undo_depth"] == 1);
  v->key("ctrl+z");
  EXPECT_REACHES(*v, s["faces"] == 2880);
  quit(*v);
}

TEST_F(ProgressiveTest, SliderAppliesWhileDragged) {
  const auto v = open({"knot", "--size", "1280x800", "--keys", "p g"});
  EXPECT_REACHES(*v, s["progressive"]["ready"] == true);
  v->settle();
  const auto move_to = [&](double share) {
    const glm::ivec2 at = point_of(*v, "detail/slider", share);
    v->move(at.x, at.y);
  };
  move_to(1.0);
  v->settle();
  v->press(1);
  move_to(0.5);
  EXPECT_REACHES(*v, s["progressive"]["faces"] < 1500);
  const auto coarse = shown(*v)["faces"].get<int>();
  move_to(0.1);
  EXPECT_REACHES(*v, s["progressive"]["faces"] < coarse);
  move_to(0.7);
  EXPECT_REACHES(*v, s["progressive"]["faces"] > coarse);
  v->release(1);
  v->settle();
  const json at_rest = shown(*v);
  EXPECT_GT(at_rest["faces"], coarse);
  EXPECT_EQ(v->state()["undo_depth"], 0);
  click(*v, "panel/geomorphs");
  EXPECT_REACHES(*v, s["progressive"]["geomorphs"] == false);
  click(*v, "panel/split colors");
  EXPECT_REACHES(*v, s["progressive"]["split_colors"] == true);
  click(*v, "panel/use this level");
  EXPECT_REACHES(*v, s["progressive"]["on"] == false && s["undo_depth"] == 1);
  EXPECT_LT(v->state()["faces"], 2880);
  v->key("ctrl+z");
  EXPECT_REACHES(*v, s["faces"] == 2880);
  quit(*v);
}

TEST_F(ProgressiveTest, PlaysUntilPausedThenSleeps) {
  const auto v = open({"knot", "--size", "1280x800", "--keys", "p home"});
  EXPECT_REACHES(*v, s["progressive"]["ready"] == true);
  v->settle();
  const glm::ivec2 play = point_of(*v, "detail/play", 0.5);
  v->move(play.x, play.y);
  v->settle();
  v->press(1);
  v->release(1);
  EXPECT_REACHES(*v, s["progressive"]["playing"] == true && s["progressive"]["position"] > 0.2);
  EXPECT_REACHES(*v, s["progressive"]["position"] > 0.3);
  v->key("space");
  EXPECT_REACHES(*v, s["progressive"]["playing"] == false);
  v->settle();
  const json at_rest = shown(*v);
  std::this_thread::sleep_for(std::chrono::milliseconds(300));
  EXPECT_EQ(shown(*v), at_rest);
  quit(*v);
}

TEST_F(ProgressiveTest, AutomaticLevelFollowsZoom) {
  const auto v = open({"knot", "--size", "1280x800", "--keys", "p"});
  EXPECT_REACHES(*v, s["progressive"]["ready"] == true);
  v->settle();
  click(*v, "panel/automatic");
  EXPECT_REACHES(*v, s["progressive"]["automatic"] == true);
  v->settle();
  const int near = shown(*v)["faces"].get<int>();
  v->move(600, 380);
  v->scroll_down(25);
  EXPECT_REACHES(*v, s["progressive"]["faces"] < near);
  v->settle();
  const int far = shown(*v)["faces"].get<int>();
  EXPECT_LT(far, near);
  v->scroll_up(25);
  EXPECT_REACHES(*v, s["progressive"]["faces"] > far);
  v->key("bracketleft");
  EXPECT_REACHES(*v, s["progressive"]["automatic"] == false);
  quit(*v);
}

TEST_F(ProgressiveTest, PipeIsShownWhileItLoads) {
  const TempFolder folder;
  const std::string pipe = folder / "pipe";
  ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
  const int out = ::open(pipe.c_str(), O_RDWR | O_CLOEXEC);
  const std::string bytes = knot_bytes();
  const std::size_t half = bytes.size() / 2;
  ASSERT_EQ(::write(out, bytes.data(), half), ssize_t(half));
  const auto v = open({pipe, "--size", "800x600"});
  EXPECT_REACHES(*v, s["progressive"]["arriving"] == true && s["progressive"]["level"] > 100);
  const int so_far = shown(*v)["faces"].get<int>();
  EXPECT_LT(so_far, 2880);
  v->settle();
  ASSERT_EQ(::write(out, bytes.data() + half, bytes.size() - half), ssize_t(bytes.size() - half));
  ::close(out);
  EXPECT_REACHES(*v, s["progressive"]["ready"] == true && s["faces"] == 2880);
  EXPECT_EQ(shown(*v)["faces"], 2880);
  EXPECT_EQ(v->state()["error"], "");
  quit(*v);
}

TEST_F(ProgressiveTest, PipeWithoutWriterDoesNotBlock) {
  const TempFolder folder;
  const std::string pipe = folder / "pipe.pm";
  ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
  const auto v = open({"cube", "--size", "800x600"});
  ASSERT_TRUE(drop_file(server_->display(), std::stoul(v->window()), pipe));
  v->settle();
  v->key("c");
  EXPECT_REACHES(*v, s["notice"].get<std::string>().starts_with("creases"));
  EXPECT_EQ(v->state()["faces"], 12) << "the shown model stays";
  const int out = ::open(pipe.c_str(), O_WRONLY | O_CLOEXEC | O_NONBLOCK);
  ASSERT_GE(out, 0) << "the viewer has it open";
  const std::string bytes = knot_bytes();
  ASSERT_EQ(::write(out, bytes.data(), bytes.size()), ssize_t(bytes.size()));
  ::close(out);
  EXPECT_REACHES(*v, s["progressive"]["ready"] == true && s["faces"] == 2880);
  quit(*v);
}

}  // namespace
}  // namespace mesher::test
