// Tests crease editing in a real window: selecting edges, changing them by keys and the panel,
// orbiting, and saving.
#include <cmath>
#include <fstream>

#include "tests/ui/window_fixture.h"

namespace mesher::test {
namespace {

class CreaseTest : public WindowTest {
 protected:
  /// Shows the front of the cube: its diagonal crosses the middle of the window.
  static std::unique_ptr<ViewerProcess> open_front() {
    auto viewer = open({"cube", "--size", "1280x800", "--view", "front"});
    viewer->key("c");
    EXPECT_REACHES(*viewer, s["creases"]["mode"] == true);
    viewer->settle();
    return viewer;
  }
  static void click_with(const char* modifier, const ViewerProcess& viewer, int x, int y) {
    server_->xdotool({"keydown", modifier});
    click(viewer, x, y);
    server_->xdotool({"keyup", modifier});
  }

  static constexpr int kMiddleX = 640;
  static constexpr int kMiddleY = 400;
  // Positions in the panel, for a window of 1280 x 800.
  static constexpr int kSliderY = 103;
  static constexpr int kInfiniteX = 1102;
  static constexpr int kInfiniteY = 129;
  static constexpr int kClearAllX = 1193;
  static constexpr int kClearAllY = 155;
  static constexpr int kTagX = 1125;
  static constexpr int kTagY = 212;
};

TEST_F(CreaseTest, ClickedEdgeIsSharpenedByKeys) {
  const auto v = open_front();
  const json start = v->state();
  v->move(kMiddleX + 60, kMiddleY);
  v->settle();
  EXPECT_TRUE(v->state()["creases"]["hovered"].is_null());
  const auto before = v->screenshot();
  v->move(kMiddleX, kMiddleY);
  EXPECT_REACHES(*v, !s["creases"]["hovered"].is_null());
  v->settle();
  EXPECT_NE(v->screenshot(), before) << "the edge under the cursor is highlighted";
  click(*v, kMiddleX, kMiddleY);
  EXPECT_REACHES(*v, s["creases"]["selected"] == 1 && s["creases"]["sharpness"] == 0.0);
  v->key("plus");
  EXPECT_REACHES(*v, s["creases"]["sharpness"] == 1.0 && s["crease_edges"] == 1);
  v->key("equal");
  EXPECT_REACHES(*v, s["creases"]["sharpness"] == 2.0);
  v->key("minus");
  EXPECT_REACHES(*v, s["creases"]["sharpness"] == 1.0);
  v->key("i");
  EXPECT_REACHES(*v, s["creases"]["sharpness"] == "inf" && s["undo_depth"] == 4);
  v->key("Delete");
  EXPECT_REACHES(*v, s["crease_edges"] == 0 && s["creases"]["selected"] == 1);
  v->key("ctrl+z");
  EXPECT_REACHES(*v, s["creases"]["sharpness"] == "inf");
  EXPECT_EQ(v->state()["camera"], start["camera"]);
  v->key("Escape");
  EXPECT_REACHES(*v, s["creases"]["selected"] == 0 && s["creases"]["mode"] == true);
  v->key("Escape");
  EXPECT_REACHES(*v, s["creases"]["mode"] == false);
  quit(*v);
}

TEST_F(CreaseTest, CtrlClickAddsDragOrbitsAndClickBesideClearsSelection) {
  const auto v = open_front();
  click(*v, kMiddleX, kMiddleY);
  EXPECT_REACHES(*v, s["creases"]["selected"] == 1);
  // The top of the front face.
  const json camera = v->state()["camera"];
  const double half =
      0.5 * 800 /
      (2 * std::tan(0.5 * 0.6108652381980153) * (camera["distance"].get<double>() - 0.5));
  click_with("ctrl", *v, kMiddleX + 60, kMiddleY - static_cast<int>(std::lround(half)) + 2);
  EXPECT_REACHES(*v, s["creases"]["selected"] == 2);
  EXPECT_EQ(v->state()["camera"], camera);
  v->drag(1, kMiddleX, kMiddleY, kMiddleX + 80, kMiddleY + 30);
  EXPECT_REACHES(*v, s["camera"] != camera && s["creases"]["selected"] == 2);
  click(*v, 400, 780);
  EXPECT_REACHES(*v, s["creases"]["selected"] == 0);
  quit(*v);
}

TEST_F(CreaseTest, SliderDragIsOneUndoStep) {
  const auto v = open_front();
  click(*v, kMiddleX, kMiddleY);
  EXPECT_REACHES(*v, s["creases"]["selected"] == 1);
  v->drag(1, 1110, kSliderY, 1180, kSliderY);
  EXPECT_REACHES(*v, s["creases"]["sharpness"] > 4.0 && s["creases"]["sharpness"] < 7.0);
  v->settle();
  EXPECT_EQ(v->state()["undo_depth"], 1);
  click(*v, kInfiniteX, kInfiniteY);
  EXPECT_REACHES(*v, s["creases"]["sharpness"] == "inf" && s["undo_depth"] == 2);
  click(*v, kTagX, kTagY);
  EXPECT_REACHES(*v, s["crease_edges"] == 13 && s["undo_depth"] == 3);
  click(*v, kClearAllX, kClearAllY);
  EXPECT_REACHES(*v, s["crease_edges"] == 0 && s["undo_depth"] == 4);
  v->key("ctrl+z");
  EXPECT_REACHES(*v, s["crease_edges"] == 13);
  quit(*v);
}

TEST_F(CreaseTest, DoubleClickSelectsChain) {
  const auto v = open({"hypersheet", "--size", "1280x800", "--view", "top"});
  v->key("c");
  EXPECT_REACHES(*v, s["creases"]["mode"] == true);
  v->settle();
  v->move(kMiddleX + 44, kMiddleY);  // half a square away from a vertex
  EXPECT_REACHES(*v, !s["creases"]["hovered"].is_null());
  server_->xdotool({"click", "--repeat", "2", "--delay", "80", "1"});
  EXPECT_REACHES(*v, s["creases"]["selected"] > 1);
  EXPECT_EQ(v->state()["notice"], "");
  quit(*v);
}

TEST_F(CreaseTest, CtrlSSavesAndConfirmsOverwrite) {
  const auto v = open({"cube", "--size", "600x400"});
  v->key("shift+c");
  EXPECT_REACHES(*v, s["crease_edges"] == 12);
  const std::string path = (v->folder() / "c.obj").string();
  const auto save_there = [&] {
    v->key("ctrl+s");
    EXPECT_REACHES(*v, s["save_dialog"] == true);
    v->settle();
    // The suggestion is selected: typing replaces it.
    server_->xdotool({"type", "--delay", "60", path});
    v->settle();
    v->key("Return");
  };
  save_there();
  EXPECT_REACHES(*v, s["save_dialog"] == false &&
                         s["notice"].get<std::string>().find("12 faces") != std::string::npos);
  const std::string first = read_bytes(path);
  EXPECT_NE(first.find("\ne "), std::string::npos);
  std::ofstream(path) << "mine";
  save_there();
  v->settle();
  EXPECT_EQ(v->state()["save_dialog"], true) << v->state().dump(2);
  EXPECT_EQ(read_bytes(path), "mine");
  v->key("Return");
  EXPECT_REACHES(*v, s["save_dialog"] == false);
  v->settle();
  EXPECT_EQ(read_bytes(path), first);
  quit(*v);
}

}  // namespace
}  // namespace mesher::test
