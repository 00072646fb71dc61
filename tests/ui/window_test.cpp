// Tests keys and gestures in a real window, with the validation layer. The program must exit with
// 0; after a validation message it exits with 3.
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <glm/vec2.hpp>
#include <sstream>
#include <thread>

#include "engine/io/png.h"
#include "tests/ui/window_fixture.h"
#include "tests/ui/xdnd_source.h"

namespace mesher::test {
namespace {

std::size_t differing_bytes(const std::vector<std::uint8_t>& a,
                            const std::vector<std::uint8_t>& b) {
  std::size_t count = a.size() == b.size() ? 0 : a.size();
  for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i)
    count += a[i] != b[i] ? 1 : 0;
  return count;
}

TEST_F(WindowTest, SingleDashOptionsOpenWindowOfGivenSize) {
  const auto v = open({"-input", "bunny.obj", "-size", "500", "-gouraud"});
  EXPECT_REACHES(*v, s["shading"] == "gouraud" && s["window"] == json::array({500.0, 500.0}));
  quit(*v);
}

TEST_F(WindowTest, ShadingKeysChangeStateAndPicture) {
  const auto v = open({"cube", "--size", "800x600"});
  v->settle();
  const auto flat = v->screenshot();
  v->key("w");
  EXPECT_REACHES(*v, s["wireframe"] == true);
  v->settle();
  const auto lines = v->screenshot();
  EXPECT_NE(lines, flat);
  v->key("g");
  EXPECT_REACHES(*v, s["shading"] == "gouraud");
  v->settle();
  EXPECT_NE(v->screenshot(), lines);
  v->key("shift+w");
  EXPECT_REACHES(*v, s["shading"] == "none");
  v->key("shift+w");
  EXPECT_REACHES(*v, s["shading"] == "flat");
  v->key("w");
  EXPECT_REACHES(*v, s["wireframe"] == false);
  v->settle();
  EXPECT_EQ(v->screenshot(), flat);
  v->key("b");
  EXPECT_REACHES(*v, s["background"] == "dark");
  v->settle();
  EXPECT_NE(v->screenshot(), flat);
  quit(*v);
}

TEST_F(WindowTest, ViewKeysRotateCamera) {
  const auto v = open({"knot", "--size", "800x600"});
  v->key("1");
  EXPECT_REACHES(*v,
                 std::abs(number(s, "yaw_rad")) < 1e-9 && std::abs(number(s, "pitch_rad")) < 1e-9);
  v->key("3");
  EXPECT_REACHES(*v, std::abs(number(s, "yaw_rad") - 1.5707963) < 1e-6);
  v->key("7");
  EXPECT_REACHES(*v, std::abs(number(s, "pitch_rad") - 1.5707963) < 1e-6);
  v->key("5");
  EXPECT_REACHES(*v, s["camera"]["orthographic"] == true);
  quit(*v);
}

TEST_F(WindowTest, KeysInHelpSearchIt) {
  const auto v = open({"cube", "--size", "800x600"});
  const auto has = [](const json& s, const char* widget) { return s["widgets"].contains(widget); };
  v->key("F1");
  EXPECT_REACHES(*v, s["help"] == true && has(s, "Help/open_file"));
  v->settle();
  for (const char* key : {"w", "i", "r", "e"})
    v->key(key);
  EXPECT_REACHES(*v, has(s, "Help/toggle_wireframe") && !has(s, "Help/open_file"));
  EXPECT_EQ(v->state()["wireframe"], false);
  v->key("question");
  EXPECT_REACHES(*v, s["help"] == false);
  v->key("w");
  EXPECT_REACHES(*v, s["wireframe"] == true) << "keys are commands again";
  quit(*v);
}

TEST_F(WindowTest, HelpPanelAndEscape) {
  const auto v = open({"cube", "--size", "1000x600"});
  v->settle();
  const auto before = v->screenshot();
  v->key("F1");
  EXPECT_REACHES(*v, s["help"] == true);
  v->settle();
  EXPECT_NE(v->screenshot(), before);
  v->key("F1");
  EXPECT_REACHES(*v, s["help"] == false);
  v->key("question");
  EXPECT_REACHES(*v, s["help"] == true);
  v->key("Escape");
  EXPECT_REACHES(*v, s["help"] == false);
  v->key("Tab");
  EXPECT_REACHES(*v, s["info"] == false);
  v->settle();
  EXPECT_NE(v->screenshot(), before);
  v->key("Escape");  // nothing is open, and Escape never quits
  v->key("Tab");
  EXPECT_REACHES(*v, s["info"] == true);
  quit(*v);
}

TEST_F(WindowTest, DragsOrbitAndPan) {
  const auto v = open({"cube", "--size", "800x600"});
  const json start = v->state();
  v->drag(1, 500, 300, 560, 330);
  EXPECT_REACHES(*v, number(s, "yaw_rad") != number(start, "yaw_rad") &&
                         number(s, "pitch_rad") != number(start, "pitch_rad") &&
                         s["camera"]["pivot"] == start["camera"]["pivot"]);
  v->settle();
  const json turned = v->state();
  v->drag(3, 500, 300, 560, 330);
  EXPECT_REACHES(*v, s["camera"]["pivot"] != turned["camera"]["pivot"] &&
                         number(s, "yaw_rad") == number(turned, "yaw_rad"));
  v->settle();
  const json moved = v->state();
  server_->xdotool({"keydown", "shift"});
  v->drag(1, 500, 300, 450, 300);
  server_->xdotool({"keyup", "shift"});
  EXPECT_REACHES(*v, s["camera"]["pivot"] != moved["camera"]["pivot"] &&
                         number(s, "yaw_rad") == number(moved, "yaw_rad"));
  v->key("f");
  EXPECT_REACHES(*v, s["camera"]["pivot"] == start["camera"]["pivot"]);
  quit(*v);
}

TEST_F(WindowTest, WheelZoomsAtCursorAndDoubleClickRecenters) {
  const auto v = open({"cube", "--size", "800x600"});
  v->key("1");
  EXPECT_REACHES(*v, number(s, "yaw_rad") == 0.0);
  const json angled = v->state();
  v->key("f");
  EXPECT_REACHES(*v, number(s, "distance") != number(angled, "distance"));
  const json start = v->state();
  v->move(600, 200);
  v->scroll_up(1);
  EXPECT_REACHES(*v, number(s, "distance") < number(start, "distance") &&
                         s["camera"]["pivot"][0] > 0.0 && s["camera"]["pivot"][1] > 0.0);
  v->key("f");
  EXPECT_REACHES(*v, number(s, "distance") == number(start, "distance"));
  v->move(430, 280);
  server_->xdotool({"click", "--repeat", "2", "--delay", "60", "1"});
  EXPECT_REACHES(*v, std::abs(s["camera"]["pivot"][2].get<double>() - 0.5) < 1e-6);
  quit(*v);
}

TEST_F(WindowTest, DragOnPanelDoesNotOrbit) {
  const auto v = open({"cube", "--size", "800x600"});
  v->settle();
  v->key("ctrl+1");
  EXPECT_REACHES(*v, s["tool"] == "model");
  v->settle();
  const json start = v->state();
  v->drag(1, 600, 300, 640, 340);
  v->settle();
  EXPECT_EQ(v->state()["camera"], start["camera"]);
  quit(*v);
}

TEST_F(WindowTest, F12SavesPicture) {
  const auto v = open({"open_box", "--size", "400x300"});
  v->key("F12");
  EXPECT_REACHES(*v,
                 s["notice"].get<std::string>().find("mesher-open_box.png") != std::string::npos);
  const Image image = io::read_png(v->folder() / "mesher-open_box.png");
  EXPECT_EQ(image.width, 400U);
  EXPECT_EQ(image.height, 300U);
  quit(*v);
}

TEST_F(WindowTest, DroppedFileIsOpenedAndBadFileGivesError) {
  const auto v = open({"cube", "--size", "800x600"});
  const unsigned long window = std::stoul(v->window());
  ASSERT_TRUE(drop_file(server_->display(), window, MESHER_SOURCE_DIR "/assets/knot.obj"));
  EXPECT_REACHES(*v, s["file"].get<std::string>().ends_with("knot.obj") && s["faces"] > 1000);
  const auto bad = v->folder().write("bad.obj", "v 0 0 0\nf 1 2 3\n");
  ASSERT_TRUE(drop_file(server_->display(), window, bad.string()));
  EXPECT_REACHES(*v, s["error"].get<std::string>().find("bad.obj:2") != std::string::npos);
  EXPECT_TRUE(
      v->state()["file"].get<std::string>().ends_with("knot.obj"));  // the previous model stays
  v->key("Escape");
  EXPECT_REACHES(*v, s["error"] == "");
  quit(*v);
}

TEST_F(WindowTest, CtrlOOpensTypedPath) {
  const auto v = open({"cube", "--size", "800x600"});
  v->key("ctrl+o");
  EXPECT_REACHES(*v, s["open_dialog"] == true);
  v->settle();
  server_->xdotool({"type", "--delay", "60", "hypersheet.obj"});
  v->settle();
  v->key("Return");
  EXPECT_REACHES(*v, s["file"].get<std::string>().ends_with("hypersheet.obj"));
  EXPECT_EQ(v->state()["open_dialog"], false);
  EXPECT_EQ(v->state()["wireframe"], false);  // the letters were text, not shortcuts
  quit(*v);
}

TEST_F(WindowTest, KeysTypedRightAfterDialogOpensAreText) {
  const auto v = open({"cube", "--size", "800x600"});
  server_->xdotool({"key", "ctrl+o", "b", "w", "q"});
  EXPECT_REACHES(*v, s["open_dialog"] == true);
  v->settle();
  EXPECT_TRUE(v->is_running());
  EXPECT_EQ(v->state()["background"], "light");
  EXPECT_EQ(v->state()["wireframe"], false);
  v->key("Escape");
  EXPECT_REACHES(*v, s["open_dialog"] == false);
  quit(*v);
}

TEST_F(WindowTest, EscapeClosesColorPicker) {
  const auto v = open({"cube", "--size", "800x800"});
  v->key("ctrl+2");
  EXPECT_REACHES(*v, s["tool"] == "look");
  v->settle();
  const auto before = v->screenshot();
  click(*v, "panel/front", 0.1);  // the swatch
  v->move(500, 700);
  v->settle();
  EXPECT_GT(differing_bytes(v->screenshot(), before), 50'000U);  // the picker is open
  v->key("Escape");
  v->settle();
  EXPECT_TRUE(v->is_running());
  EXPECT_LT(differing_bytes(v->screenshot(), before), 5'000U);  // all but the frame time
  quit(*v);
}

TEST_F(WindowTest, PanelControlsWork) {
  const auto v = open({"cube", "--size", "800x800"});
  v->settle();
  v->key("ctrl+2");
  click(*v, "panel/Gouraud");
  EXPECT_REACHES(*v, s["shading"] == "gouraud");
  click(*v, "panel/wireframe");
  EXPECT_REACHES(*v, s["wireframe"] == true);
  slide(*v, "panel/crease angle", 1.0, 0.5);
  EXPECT_REACHES(*v, s["crease_angle_deg"] < 150.0);
  click(*v, "panel/dark");
  EXPECT_REACHES(*v, s["background"] == "dark");
  quit(*v);
}

TEST_F(WindowTest, CommandLineKeysActAsInScript) {
  const auto v = open({"cube", "--size", "200", "--keys", "f12 w f12"});
  v->settle();
  const auto first = io::read_png(v->folder() / "mesher-cube.png");
  const auto second = io::read_png(v->folder() / "mesher-cube-2.png");
  EXPECT_FALSE(first.rgba == second.rgba);
  quit(*v);
}

TEST_F(WindowTest, HandlesResizeAndMinimize) {
  const auto v = open({"cube", "--size", "800x600"});
  for (const glm::ivec2 size : {glm::ivec2(300, 200), {1000, 700}, {64, 64}, {640, 480}}) {
    server_->xdotool(
        {"windowsize", "--sync", v->window(), std::to_string(size.x), std::to_string(size.y)});
    EXPECT_REACHES(*v, s["window"] == json::array({double(size.x), double(size.y)}));
  }
  server_->xdotool({"windowunmap", "--sync", v->window()});
  server_->xdotool({"windowmap", "--sync", v->window()});
  server_->xdotool({"windowfocus", "--sync", v->window()});
  v->key("w");
  EXPECT_REACHES(*v, s["wireframe"] == true);
  quit(*v);
}

TEST_F(WindowTest, SleepsWithoutEvents) {
  const auto v = open({"cube", "--size", "400x300"});
  v->settle();
  const auto cpu_ticks = [&] {
    const Finished run =
        run_program({"xdotool", "getwindowpid", v->window()}, {server_->environment()});
    const std::string pid = run.out.substr(0, run.out.find('\n'));
    const Finished ps = run_program({"cat", "/proc/" + pid + "/stat"});
    // Fields 14 and 15 of proc(5)'s stat, counted after the name in brackets.
    std::istringstream fields(ps.out.substr(ps.out.rfind(')') + 2));
    std::string field;
    long ticks = 0;
    for (int i = 3; fields >> field && i <= 15; ++i) {
      if (i >= 14) ticks += std::stol(field);
    }
    return ticks;
  };
  const long before = cpu_ticks();
  ASSERT_GT(before, 0);
  std::this_thread::sleep_for(std::chrono::seconds(2));
  EXPECT_LE(cpu_ticks() - before, 10);  // of 200
  quit(*v);
}

TEST_F(WindowTest, RailShowsOneToolAtATime) {
  const auto v = open({"cube", "--size", "1200x800"});
  EXPECT_REACHES(*v, s["tool"] == "simplify" && s["info"] == true);
  const json rectangle = v->state()["model_rectangle"];
  EXPECT_LT(rectangle[2], 800);
  for (const char* tool : {"subdivide", "creases", "levels", "look"}) {
    click(*v, std::string("rail/") + tool);
    EXPECT_REACHES(*v, s["tool"] == tool);
    EXPECT_EQ(v->state()["creases"]["mode"], std::string(tool) == "creases");
    EXPECT_EQ(v->state()["model_rectangle"], rectangle) << "no panel moves another";
  }
  v->key("c");
  EXPECT_REACHES(*v, s["tool"] == "creases" && s["creases"]["mode"] == true);
  quit(*v);
}

TEST_F(WindowTest, SmallWindowShowsRailAndBarOnly) {
  const auto v = open({"cube", "--size", "300", "--wireframe"});
  v->settle();
  const json all = v->state();
  EXPECT_EQ(all["info"], false);
  EXPECT_EQ(all["notice"], "");
  EXPECT_GE(all["model_rectangle"][2].get<double>() * all["model_rectangle"][3].get<double>(),
            0.65 * 300 * 300);
  click(*v, "rail/subdivide");
  EXPECT_REACHES(*v, s["tool"] == "subdivide" && s["info"] == true);
  EXPECT_EQ(v->state()["model_rectangle"], all["model_rectangle"]);
  v->move(150, 100);
  v->scroll_down(20);
  click(*v, "panel/subdivide");
  EXPECT_REACHES(*v, s["faces"] == 48);
  click(*v, "rail/subdivide");
  EXPECT_REACHES(*v, s["info"] == false);
  click(*v, "rail/look");
  EXPECT_REACHES(*v, s["info"] == true);
  v->settle();
  v->key("Escape");
  EXPECT_REACHES(*v, s["info"] == false);
  v->drag(1, 150, 100, 190, 120);
  EXPECT_REACHES(*v, s["camera"] != all["camera"]);
  slide(*v, "detail/slider", 1.0, 0.3);
  EXPECT_REACHES(*v, s["faces"] < 12);
  quit(*v);
}

TEST_F(WindowTest, MenusRunCommandsAndRefuseWithAReason) {
  const auto v = open({"knot", "--size", "1000x700"});
  click(*v, "/menu simplify");
  click(*v, "/simplify");
  EXPECT_REACHES(*v, s["faces"] == 2592);
  // A right click that does not drag opens the menu of the tool.
  v->settle();
  v->move(450, 300);
  v->press(3);
  v->release(3);
  click(*v, "/simplify");
  EXPECT_REACHES(*v, s["faces"] < 2592);
  quit(*v);
}

TEST_F(WindowTest, PaletteFindsAndRunsACommand) {
  const auto v = open({"knot", "--size", "1000x700"});
  v->key("ctrl+k");
  EXPECT_REACHES(*v, s["palette"] == true);
  v->settle();
  server_->xdotool({"type", "--delay", "60", "gouraud"});
  v->settle();
  v->key("Return");
  EXPECT_REACHES(*v, s["palette"] == false && s["shading"] == "gouraud");
  EXPECT_EQ(v->state()["wireframe"], false) << "the letters were text, not commands";
  v->key("ctrl+k");
  EXPECT_REACHES(*v, s["palette"] == true);
  v->settle();
  v->key("Escape");
  EXPECT_REACHES(*v, s["palette"] == false);
  quit(*v);
}

TEST_F(WindowTest, HistoryIsClickedBackAndForth) {
  const auto v = open({"knot", "--size", "1200x800"});
  v->key("d");
  EXPECT_REACHES(*v, s["undo_depth"] == 1);
  v->key("s");
  EXPECT_REACHES(*v, s["undo_depth"] == 2);
  v->key("d");
  EXPECT_REACHES(*v, s["undo_depth"] == 3);
  const int faces = v->state()["faces"].get<int>();
  click(*v, "facts/step 0");
  EXPECT_REACHES(*v, s["undo_depth"] == 0 && s["redo_depth"] == 3 && s["faces"] == 2880);
  click(*v, "facts/step 3");
  EXPECT_REACHES(*v, s["undo_depth"] == 3 && s["faces"] == faces);
  quit(*v);
}

TEST_F(WindowTest, ArrowKeysChooseInLists) {
  const auto v = open({"knot", "--size", "1000x700"});
  click(*v, "panel/cost");
  v->settle();
  for (const char* key : {"Down", "Down", "space"}) {
    v->key(key);
    v->settle();
  }
  EXPECT_REACHES(*v, s["simplify"]["cost"] != "quadric");
  // A click on the model gives the keys back to the commands.
  click(*v, 450, 300);
  v->key("Tab");
  EXPECT_REACHES(*v, s["info"] == false);
  quit(*v);
}

TEST_F(WindowTest, ScaleEnlargesPanels) {
  const auto once = open({"cube", "--size", "1200x800"});
  const auto twice = open({"cube", "--size", "1200x800", "--ui-scale", "2"});
  once->settle();
  twice->settle();
  const auto height = [](const ViewerProcess& v) {
    const glm::dvec4 place = place_of(v, "detail/slider");
    return place.w - place.y;
  };
  EXPECT_NEAR(height(*twice) / height(*once), 2.0, 0.1);
  EXPECT_EQ(twice->state()["info"], false) << "600 points are no room for docks";
  quit(*once);
  quit(*twice);
}

TEST_F(WindowTest, DefaultSizeFollowsMonitorAndFitsScreen) {
  const auto size_at = [](const char* resources, std::vector<std::string> arguments) {
    server_->set_resources(resources);
    arguments.insert(arguments.begin(), "cube");
    const auto v = open(arguments);
    v->settle();
    const json window = v->state()["window"];
    EXPECT_TRUE(v->state()["info"].get<bool>());
    quit(*v);
    server_->set_resources("");
    return glm::dvec2(window[0], window[1]);
  };
  EXPECT_EQ(size_at("", {}), glm::dvec2(1280, 800));
  EXPECT_EQ(size_at("Xft.dpi:\t72\n", {}), glm::dvec2(960, 600));
  EXPECT_EQ(size_at("Xft.dpi:\t120\n", {}), glm::dvec2(1280, 900)) << "the size of the screen";
  EXPECT_EQ(size_at("Xft.dpi:\t120\n", {"--ui-scale", "0.75"}), glm::dvec2(960, 600));
  EXPECT_EQ(size_at("Xft.dpi:\t96\n", {"--size", "1000x700"}), glm::dvec2(1000, 700));
}

}  // namespace
}  // namespace mesher::test
