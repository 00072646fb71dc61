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

  /// The middle of the model's rectangle.
  static glm::ivec2 middle(const ViewerProcess& viewer) {
    const json place = viewer.state()["model_rectangle"];
    return {place[0].get<double>() + place[2].get<double>() / 2,
            place[1].get<double>() + place[3].get<double>() / 2};
  }
};

TEST_F(CreaseTest, ClickedEdgeIsSharpenedByKeys) {
  const auto v = open_front();
  const json start = v->state();
  const glm::ivec2 center = middle(*v);
  v->move(center.x + 60, center.y);
  v->settle();
  EXPECT_TRUE(v->state()["creases"]["hovered"].is_null());
  const auto before = v->screenshot();
  v->move(center.x, center.y);
  EXPECT_REACHES(*v, !s["creases"]["hovered"].is_null());
  v->settle();
  EXPECT_NE(v->screenshot(), before) << "the edge under the cursor is highlighted";
  click(*v, center.x, center.y);
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
  const glm::ivec2 center = middle(*v);
  click(*v, center.x, center.y);
  EXPECT_REACHES(*v, s["creases"]["selected"] == 1);
  // The top of the front face.
  const json camera = v->state()["camera"];
  const double half =
      0.5 * v->state()["model_rectangle"][3].get<double>() /
      (2 * std::tan(0.5 * 0.6108652381980153) * (camera["distance"].get<double>() - 0.5));
  click_with("ctrl", *v, center.x + 60, center.y - static_cast<int>(std::lround(half)) + 2);
  EXPECT_REACHES(*v, s["creases"]["selected"] == 2);
  EXPECT_EQ(v->state()["camera"], camera);
  v->drag(1, center.x, center.y, center.x + 80, center.y + 30);
  EXPECT_REACHES(*v, s["camera"] != camera && s["creases"]["selected"] == 2);
  click(*v, center.x - 180, center.y + 300);
  EXPECT_REACHES(*v, s["creases"]["selected"] == 0);
  quit(*v);
}

TEST_F(CreaseTest, SliderDragIsOneUndoStep) {
  const auto v = open_front();
  const glm::ivec2 center = middle(*v);
  click(*v, center.x, center.y);
  EXPECT_REACHES(*v, s["creases"]["selected"] == 1);
  slide(*v, "panel/sharpness", 0.0, 0.5);
  EXPECT_REACHES(*v, s["creases"]["sharpness"] > 4.0 && s["creases"]["sharpness"] < 7.0);
  v->settle();
  EXPECT_EQ(v->state()["undo_depth"], 1);
  click(*v, "panel/infinite");
  EXPECT_REACHES(*v, s["creases"]["sharpness"] == "inf" && s["undo_depth"] == 2);
  click(*v, "panel/tag");
  EXPECT_REACHES(*v, s["crease_edges"] == 13 && s["undo_depth"] == 3);
  click(*v, "panel/clear all");
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
  const glm::ivec2 center = middle(*v);
  v->move(center.x + 44, center.y);  // half a square away from a vertex
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
