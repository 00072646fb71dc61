// Tests simplification in a real window: keys, buttons and the slider change the model, and the
// camera does not move.
#include <cmath>

#include "tests/ui/window_fixture.h"

namespace mesher::test {
namespace {

class EditTest : public WindowTest {};

TEST_F(EditTest, DAndShiftDSimplifyAndCanBeUndone) {
  const auto v = open({"knot", "--size", "800x600"});
  v->settle();
  const json start = v->state();
  const auto before = v->screenshot();
  ASSERT_EQ(start["faces"], 2880);
  v->key("d");
  EXPECT_REACHES(*v, s["faces"] == 2592 && s["undo_depth"] == 1);
  v->key("shift+d");
  EXPECT_REACHES(*v, s["faces"] == 2590 && s["undo_depth"] == 2);
  EXPECT_EQ(v->state()["camera"], start["camera"]);
  v->settle();
  EXPECT_NE(v->screenshot(), before);
  v->key("ctrl+z");
  EXPECT_REACHES(*v, s["faces"] == 2592 && s["redo_depth"] == 1);
  v->key("ctrl+z");
  EXPECT_REACHES(*v, s["faces"] == 2880 && s["redo_depth"] == 2);
  v->key("ctrl+shift+z");
  EXPECT_REACHES(*v, s["faces"] == 2592);
  v->key("ctrl+y");
  EXPECT_REACHES(*v, s["faces"] == 2590 && s["redo_depth"] == 0);
  EXPECT_EQ(v->state()["camera"], start["camera"]);
  quit(*v);
}

TEST_F(EditTest, EnterPressesTheFocusedWidget) {
  const auto v = open({"knot", "--size", "1280x800"});
  v->key("ctrl+3");
  click(*v, "panel/max error");
  for (const char* key : {"Return", "Down", "Return"}) {
    v->key(key);
    v->settle();
  }
  EXPECT_REACHES(*v, s["undo_depth"] == 1);
  quit(*v);
}

TEST_F(EditTest, MaxErrorIsTypedAndNeedsNoNumberOfFaces) {
  const auto v = open({"knot", "--size", "1280x800"});
  v->key("ctrl+3");
  click(*v, "panel/faces");
  // Held, because ImGui 1.86 misses keys that are released before the next frame.
  server_->xdotool({"key", "--delay", "400", "ctrl+a", "BackSpace", "Return"});
  click(*v, "panel/max error");
  for (const char* key : {"0", "period", "5", "Return"})
    v->key(key);
  EXPECT_REACHES(*v, s["simplify"]["max_error_percent"] == 0.5);
  click(*v, "panel/simplify");
  EXPECT_REACHES(*v, s["undo_depth"] == 1 && s["last_simplification"]["asked_faces"].is_null());
  EXPECT_LT(v->state()["faces"], 2880);
  quit(*v);
}

TEST_F(EditTest, QuickKeyPressesAreQueued) {
  const auto v = open({"knot", "--size", "400x300"});
  server_->xdotool({"key", "--delay", "1", "d", "d", "d"});
  EXPECT_REACHES(*v, s["undo_depth"] == 3);
  EXPECT_LE(v->state()["faces"], 2099);
  quit(*v);
}

TEST_F(EditTest, LastLegalCollapseGivesNotice) {
  const auto v = open({"cube", "--size", "400x300", "--gouraud"});
  server_->xdotool({"key", "--repeat", "12", "--delay", "20", "d"});
  EXPECT_REACHES(*v, s["notice"].get<std::string>().find("no legal collapse is left") == 0);
  quit(*v);
}

TEST_F(EditTest, SliderAppliesOnReleaseAndRestoresDetail) {
  const auto v = open({"knot", "--size", "1280x800"});
  slide(*v, "detail/slider", 1.0, 0.6);
  EXPECT_REACHES(*v, s["faces"] < 2500 && s["undo_depth"] == 1);
  const auto coarse = v->state()["faces"].get<int>();
  v->settle();
  const auto share = std::log(coarse / 4.0) / std::log(2880 / 4.0);
  slide(*v, "detail/slider", share, 1.1);
  EXPECT_REACHES(*v, s["faces"] == 2880 && s["undo_depth"] == 2);
  v->key("ctrl+z");
  EXPECT_REACHES(*v, s["faces"] == coarse);
  quit(*v);
}

TEST_F(EditTest, SliderEndsAtOpenedFaceCount) {
  const auto v = open({"knot", "--size", "1280x800"});
  v->key("s");
  EXPECT_REACHES(*v, s["faces"] == 4 * 2880);
  slide(*v, "detail/slider", 1.0, 0.9);
  EXPECT_REACHES(*v, s["faces"] < 2880);
  quit(*v);
}

TEST_F(EditTest, PanelButtonsWork) {
  const auto v = open({"knot", "--size", "1280x800"});
  v->settle();
  const json start = v->state();
  click(*v, "panel/remove 10 %");
  EXPECT_REACHES(*v, s["faces"] == 2592);
  click(*v, "panel/one edge");
  EXPECT_REACHES(*v, s["faces"] == 2590);
  click(*v, "facts/step 1");
  EXPECT_REACHES(*v, s["faces"] == 2592);
  click(*v, "facts/step 2");
  EXPECT_REACHES(*v, s["faces"] == 2590);
  click(*v, "panel/cost");
  click(*v, "/random");
  EXPECT_REACHES(*v, s["simplify"]["cost"] == "random");
  EXPECT_EQ(v->state()["camera"], start["camera"]);
  quit(*v);
}

TEST_F(EditTest, OpenedFileHasItsOwnHistory) {
  const auto v = open({"knot", "--size", "800x600"});
  v->key("d");
  EXPECT_REACHES(*v, s["undo_depth"] == 1);
  v->key("ctrl+o");
  EXPECT_REACHES(*v, s["open_dialog"] == true);
  v->settle();
  server_->xdotool({"type", "--delay", "60", "cube.obj"});
  v->settle();
  v->key("KP_Enter");
  EXPECT_REACHES(*v, s["faces"] == 12 && s["undo_depth"] == 0);
  v->key("ctrl+z");
  EXPECT_REACHES(*v, s["notice"] == "nothing to undo" && s["faces"] == 12);
  v->key("ctrl+Next");
  EXPECT_REACHES(*v, s["faces"] == 2592 && s["undo_depth"] == 1 && s["tab"] == 0);
  v->key("ctrl+z");
  EXPECT_REACHES(*v, s["faces"] == 2880);
  quit(*v);
}

TEST_F(EditTest, CommandLineKeysActAsInScript) {
  const auto v = open({"knot", "--size", "400x300", "--keys", "d shift+d ctrl+z"});
  EXPECT_REACHES(*v, s["faces"] == 2592 && s["redo_depth"] == 1);
  quit(*v);
}

}  // namespace
}  // namespace mesher::test
