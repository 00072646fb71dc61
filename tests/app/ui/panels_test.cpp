#include "app/ui/panels.h"

#include <gtest/gtest.h>
#include <imgui.h>
#include <imgui_internal.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <ostream>
#include <string>
#include <utility>
#include <vector>

#include "app/cli/view.h"
#include "app/document/tabs.h"
#include "app/files/leave.h"
#include "app/files/paths.h"
#include "app/files/picture_requests.h"
#include "app/input/commands.h"
#include "app/input/keys.h"
#include "app/ui/font_finder.h"
#include "app/viewer/scripted_session.h"
#include "engine/io/read.h"
#include "tests/support/golden.h"
#include "tests/support/gpu_test.h"

namespace mesher::app {
namespace {

struct Shot {
  const char* name;
  glm::dvec2 window;
  float scale;
  const char* keys;
  void (*prepare)(Session&) = nullptr;  ///< after the keys
  const char* clicked = nullptr;        ///< a widget that the mouse presses then
  friend std::ostream& operator<<(std::ostream& out, const Shot& shot) { return out << shot.name; }
};

constexpr Shot kShots[] = {
    {"window_300", {300.0, 300.0}, 1.0F, "w"},
    {"window_300_panel_dark", {300.0, 300.0}, 1.0F, "b ctrl+4"},
    {"window_500_dark", {500.0, 500.0}, 1.0F, "b d ctrl+3"},
    {"window_800", {800.0, 600.0}, 1.0F, "w ctrl+1"},
    {"window_800_creases_dark", {800.0, 600.0}, 1.0F, "b c shift+c ctrl+a ctrl+5"},
    {"window_1400", {1400.0, 900.0}, 1.0F, "d d s ctrl+3"},
    {"window_1400_levels_dark", {1400.0, 900.0}, 1.0F, "b p w pagedown"},
    {"window_twice", {2000.0, 1300.0}, 2.0F, "ctrl+2"},
};

namespace fs = std::filesystem;

/// A home with models of fixed names, sizes and dates, at a fixed place: dialogs show all of them.
class Home {
 public:
  Home() {
    fs::create_directories(kModels / "scans");
    write("bunny.obj", 204'511, 0);
    write("knot.ply", 1'250'000, 1);
    write("\u5154\u5b50.glb", 88'012, 2);
    write("statue of a lion, scanned in the garden, all parts merged.stl", 912'000'000, 3);
    write("turn.webp", 350'000, 4);
    write("view.png", 52'000, 5);
    set_time(kModels / "scans", 6);
    for (const auto& [name, value] : {std::pair("HOME", kHome.c_str()), {"TZ", "UTC"}}) {
      const char* before = std::getenv(name);
      before_.emplace_back(name, before != nullptr ? before : "");
      setenv(name, value, 1);
    }
    tzset();
  }
  ~Home() {
    for (const auto& [name, value] : before_)
      value.empty() ? unsetenv(name) : setenv(name, value.c_str(), 1);
    tzset();
  }
  Home(const Home&) = delete;
  Home& operator=(const Home&) = delete;

  static inline const fs::path kHome = "/tmp/mesher-golden-home";
  static inline const fs::path kModels = kHome / "models";

 private:
  static fs::file_time_type day(int number) {
    constexpr std::chrono::sys_days kFirst = std::chrono::year(2026) / 3 / 1;
    // In nanoseconds: libstdc++ 12 converts no coarser times.
    const std::chrono::sys_time<std::chrono::nanoseconds> time =
        kFirst + std::chrono::days(number) + std::chrono::hours(9);
    return fs::file_time_type::clock::from_sys(time);
  }
  /// Tests of another process may be reading: what is right is left alone.
  static void write(const char* name, std::uintmax_t bytes, int number) {
    const fs::path file = kModels / name;
    if (fs::exists(file) && fs::file_size(file) == bytes) return set_time(file, number);
    std::ofstream(file).flush();
    fs::resize_file(file, bytes);  // no bytes are stored: the file has a hole
    set_time(file, number);
  }
  static void set_time(const fs::path& file, int number) {
    if (fs::last_write_time(file) != day(number)) fs::last_write_time(file, day(number));
  }

  std::vector<std::pair<const char*, std::string>> before_;
};

void add_tabs(Session& s) {
  for (const char* name : {"statue of a lion, scanned in the garden, all parts merged.stl",
                           "\u5154\u5b50.glb", "knot.obj", "knot.obj"}) {
    Model model = s.document.model;
    model.name = name;
    add_tab(s);
    show_model(s, std::move(model), Home::kModels / name);
  }
  show_tab(s, 1);
}

void ask_unsaved(Session& s) {
  s.document.file = Home::kModels / "knot.obj";
  request_leave(s, Leaving::quit);
}

void show_opening(Session& s) {
  s.preferences.recent = {Home::kModels / "bunny.obj", Home::kModels / "knot.ply"};
  s.preferences.open_folder = Home::kModels;
  run(s, "open_file");
}

void show_start(Session& s) {
  s.preferences.recent = {Home::kModels / "bunny.obj", Home::kModels / "\u5154\u5b50.glb"};
  // The folder may also hold models that were fetched for tests.
  for (const char* name : {"bunny", "bunny_1k", "bunny_200", "cactus", "creased_cube", "cube",
                           "hypersheet", "knot", "open_box", "semi_sharp_cube", "uneven_cube"})
    s.samples.push_back(samples_folder() / (std::string(name) + ".obj"));
  s.shows_start = true;
}

void show_saving(Session& s) {
  s.preferences.save_folder = Home::kModels;
  run(s, "save_file");
}

void show_picture(Session& s) {
  s.preferences.picture_folder = Home::kModels;
  run(s, "picture");
}

void show_turntable(Session& s) {
  show_picture(s);
  choose_turn(s.picture, true);
}

/// A cube with creases of several sharpnesses.
void sharpen(Session& s) {
  show_model(s, io::read_model(MESHER_SOURCE_DIR "/assets/semi_sharp_cube.obj"), "cube.obj");
  s.view.settings.wireframe = true;
}

void color_levels(Session& s) {
  ProgressiveSettings settings = s.document.progressive.settings();
  settings.colors_by_split_order = true;
  s.document.progressive.change(settings);
}

constexpr Shot kDialogs[] = {
    {"window_tabs_1400", {1400.0, 900.0}, 1.0F, "", add_tabs},
    {"window_tabs_800_dark", {800.0, 600.0}, 1.0F, "b", add_tabs},
    {"window_start_800", {800.0, 600.0}, 1.0F, "", show_start},
    {"window_start_300_dark", {300.0, 300.0}, 1.0F, "b", show_start},
    {"window_start_twice", {1600.0, 1000.0}, 2.0F, "", show_start},
    {"window_open_1400_dark", {1400.0, 900.0}, 1.0F, "b", show_opening},
    {"window_open_300", {300.0, 300.0}, 1.0F, "", show_opening},
    {"window_open_twice", {1600.0, 1000.0}, 2.0F, "", show_opening},
    {"window_save_800", {800.0, 600.0}, 1.0F, "", show_saving},
    {"window_save_300_dark", {300.0, 300.0}, 1.0F, "b", show_saving},
    {"window_save_twice_dark", {1600.0, 1000.0}, 2.0F, "b", show_saving},
    {"window_picture_800_dark", {800.0, 600.0}, 1.0F, "b", show_turntable},
    {"window_picture_300", {300.0, 300.0}, 1.0F, "", show_picture},
    {"window_picture_twice", {1600.0, 1200.0}, 2.0F, "", show_picture},
    {"window_question_800", {800.0, 600.0}, 1.0F, "d s", ask_unsaved},
    {"window_question_300_dark", {300.0, 300.0}, 1.0F, "b d s", ask_unsaved},
    {"window_question_twice", {1200.0, 800.0}, 2.0F, "d s", ask_unsaved},
    {"window_palette_800_dark", {800.0, 600.0}, 1.0F, "b ctrl+k"},
    {"window_palette_300", {300.0, 300.0}, 1.0F, "ctrl+k"},
    {"window_palette_twice", {1200.0, 800.0}, 2.0F, "ctrl+k"},
    {"window_help_800", {800.0, 600.0}, 1.0F, "f1"},
    {"window_help_300_dark", {300.0, 300.0}, 1.0F, "b f1"},
    {"window_help_twice_dark", {1400.0, 1000.0}, 2.0F, "b f1"},
    {"window_menu_800_dark", {800.0, 600.0}, 1.0F, "b d", nullptr, "/menu edit"},
    {"window_menu_300", {300.0, 300.0}, 1.0F, "", nullptr, "rail/menus"},
    {"window_menu_twice", {1400.0, 1000.0}, 2.0F, "", nullptr, "/menu look"},
    {"window_legend_800", {800.0, 600.0}, 1.0F, "ctrl+5", sharpen},
    {"window_legend_300_dark", {300.0, 300.0}, 1.0F, "b", sharpen},
    {"window_legend_1400_dark", {1400.0, 900.0}, 1.0F, "b p g", color_levels},
    {"window_legend_twice", {1600.0, 1200.0}, 2.0F, "p g w", color_levels},
};

Session open_knot(const Shot& shot) {
  Session session;
  session.view.window = shot.window;
  set_default_view(session.view.camera);
  open_whole(session, {.model = MESHER_SOURCE_DIR "/assets/knot.obj"}, {.quiet = true});
  session.shows_info = fits_docks(shot.window, shot.scale);
  return session;
}

/// Rows of a list touch: their areas may share a rounded pixel, or two at twice the size.
bool overlap(const glm::vec4& a, const glm::vec4& b) {
  return std::min(a.z, b.z) - std::max(a.x, b.x) > 2.0F &&
         std::min(a.w, b.w) - std::max(a.y, b.y) > 2.0F;
}

std::string window_of(const std::string& name) {
  return name.substr(0, name.find('/'));
}

/// Expects that no widget of a window covers another, or sticks out of the picture at the side.
void expect_apart(const WidgetAreas& widgets, const glm::dvec2& window) {
  for (auto a = widgets.begin(); a != widgets.end(); ++a) {
    EXPECT_GE(a->second.x, 0.0F) << a->first;
    EXPECT_LE(a->second.z, window.x) << a->first;
    for (auto b = std::next(a); b != widgets.end(); ++b) {
      if (window_of(a->first) != window_of(b->first)) continue;
      EXPECT_FALSE(overlap(a->second, b->second)) << a->first << " and " << b->first;
    }
  }
}

/// The time that an edit takes is not the same twice.
void forget_times(Edits& edits) {
  for (auto& [state, outcome] : edits.outcomes) {
    if (outcome.simplification) outcome.simplification->report.seconds = {};
    if (outcome.subdivision) outcome.subdivision->seconds = 0.0;
  }
}

/// Presses the mouse on a widget for a few frames, as in a window.
void press(const WidgetAreas& widgets, const std::string& name, ScriptedSession& script) {
  ASSERT_TRUE(widgets.contains(name)) << name;
  const glm::vec4 area = widgets.at(name);
  ImGuiIO& io = ImGui::GetIO();
  io.MousePos = {0.5F * (area.x + area.z), 0.5F * (area.y + area.w)};
  io.MouseDown[0] = true;
  (void)script.picture();
  io.MouseDown[0] = false;
}

class PanelsOf : public test::GpuTest, public testing::WithParamInterface<Shot> {};

TEST_P(PanelsOf, WindowLooksAsItsGolden) {
  const Shot& shot = GetParam();
  const Home home;
  Session session = open_knot(shot);
  ScriptedSession script(
      session, {.device = "", .validation = true, .panels = true, .ui_scale = shot.scale});
  script.press(parse_keys(shot.keys));
  if (shot.prepare != nullptr) shot.prepare(session);
  forget_times(session.document.edits);
  Image picture = script.picture();
  if (shot.clicked != nullptr) {
    press(*script.widgets(), shot.clicked, script);
    picture = script.picture();
  }
  script.expect_no_messages();
  ASSERT_NE(script.widgets(), nullptr);
  EXPECT_GE(script.widgets()->size(), 7U);
  expect_apart(*script.widgets(), shot.window);
#if IMGUI_VERSION_NUM == 18600
  test::expect_golden(device(), shot.name, picture);
#else
  GTEST_SKIP() << "the goldens of the window show Dear ImGui 1.86";
#endif
}

INSTANTIATE_TEST_SUITE_P(Panels, PanelsOf, testing::ValuesIn(kShots),
                         [](const auto& each) { return std::string(each.param.name); });
INSTANTIATE_TEST_SUITE_P(PanelsDialogs, PanelsOf, testing::ValuesIn(kDialogs),
                         [](const auto& each) { return std::string(each.param.name); });

TEST(Panels, EveryToolFitsEverySize) {
  Session session = open_knot(kShots[0]);
  for (const float scale : {1.0F, 2.0F}) {
    ScriptedSession script(session,
                           {.device = "", .validation = true, .panels = true, .ui_scale = scale});
    for (const glm::dvec2 points : {glm::dvec2(300, 300), {500, 500}, {800, 600}, {1400, 900}}) {
      session.view.window = points * double(scale);
      for (const char* key : {"ctrl+1", "ctrl+2", "ctrl+3", "ctrl+4", "ctrl+5", "ctrl+6"}) {
        SCOPED_TRACE(testing::Message() << key << " at " << points.x << ", scale " << scale);
        script.press(parse_keys(key));
        (void)script.picture();
        expect_apart(*script.widgets(), session.view.window);
      }
    }
    script.expect_no_messages();
  }
}

/// A dialog, and the widgets that a person needs to leave it.
struct DialogCase {
  void (*show)(Session&);
  std::vector<std::string> needed;
};

TEST(Panels, EveryDialogFitsEverySize) {
  const Home home;
  const std::vector<DialogCase> dialogs{
      {show_start, {"Welcome to mesher/open"}},
      {show_opening, {"Open a model/open", "Open a model/name"}},
      {show_saving, {"Save the model/save", "Save the model/name", "Save the model/format"}},
      {show_picture, {"Save a picture/save", "Save a picture/name"}},
      {show_turntable, {"Save a picture/save"}},
      {ask_unsaved, {"mesher/Save... (S)", "mesher/Discard (Del)", "mesher/Cancel (Esc)"}},
      {[](Session& s) { s.shows_help = true; }, {"Help/filter"}},
      {[](Session& s) { s.shows_palette = true; }, {"Find a command/undo"}},
  };
  for (const float scale : {1.0F, 2.0F}) {
    for (const glm::dvec2 points : {glm::dvec2(300, 300), {500, 500}, {800, 600}, {1400, 900}}) {
      for (std::size_t i = 0; i < dialogs.size(); ++i) {
        SCOPED_TRACE(testing::Message()
                     << "dialog " << i << " at " << points.x << ", scale " << scale);
        Session session = open_knot({"", points * double(scale), scale, ""});
        ScriptedSession script(
            session, {.device = "", .validation = true, .panels = true, .ui_scale = scale});
        script.press(parse_keys("d"));
        dialogs[i].show(session);
        (void)script.picture();
        expect_apart(*script.widgets(), session.view.window);
        for (const std::string& widget : dialogs[i].needed) {
          ASSERT_TRUE(script.widgets()->contains(widget)) << widget;
          EXPECT_GE(script.widgets()->at(widget).y, 0.0F) << widget;
          EXPECT_LE(script.widgets()->at(widget).w, session.view.window.y) << widget;
        }
        script.expect_no_messages();
      }
    }
  }
}

TEST(Panels, ButtonsOfEveryToolAreInSightInSmallWindows) {
  const std::pair<const char*, const char*> tools[] = {{"ctrl+3", "panel/simplify"},
                                                       {"ctrl+4", "panel/subdivide"},
                                                       {"ctrl+5", "panel/tag"},
                                                       {"ctrl+6", "panel/build levels"},
                                                       {"p", "panel/use this level"}};
  Session session = open_knot(kShots[0]);
  ScriptedSession script(session,
                         {.device = "", .validation = true, .panels = true, .ui_scale = 1.0F});
  for (const auto& [key, button] : tools) {
    script.press(parse_keys(key));
    session.shows_info = true;
    (void)script.picture();
    ASSERT_TRUE(script.widgets()->contains(button)) << button;
    EXPECT_LE(script.widgets()->at(button).w, 242.0F) << button << " is above the detail bar";
  }
  script.expect_no_messages();
}

bool has_tooltip() {
  const ImGuiWindow* window = ImGui::FindWindowByName("##Tooltip_00");
  return window != nullptr && window->Active;
}

TEST(Panels, TooltipsDoNotCoverDialogs) {
  Session session = open_knot(kShots[3]);
  ScriptedSession script(session,
                         {.device = "", .validation = true, .panels = true, .ui_scale = 1.0F});
  (void)script.picture();
  const glm::vec4 button = script.widgets()->at("rail/simplify");
  ImGui::GetIO().MousePos = {0.5F * (button.x + button.z), 0.5F * (button.y + button.w)};
  (void)script.picture();
  EXPECT_TRUE(has_tooltip());
  for (bool Session::*dialog : {&Session::shows_help, &Session::shows_palette}) {
    session.*dialog = true;
    (void)script.picture();
    EXPECT_FALSE(has_tooltip()) << "the mouse is beside the dialog";
    session.*dialog = false;
  }
  (void)script.picture();
  EXPECT_TRUE(has_tooltip());
}

Image picture_named(const std::string& name) {
  Session session = open_knot(kShots[5]);
  session.document.model.name = name;
  ScriptedSession script(session,
                         {.device = "", .validation = true, .panels = true, .ui_scale = 1.0F});
  Image picture = script.picture();
  EXPECT_EQ(script.picture().rgba, picture.rgba) << "the glyphs are there at once";
  script.expect_no_messages();
  return picture;
}

TEST(Panels, NamesInOtherScriptsAreShown) {
  // Names of the same width whose glyphs are missing would give the same picture.
  EXPECT_NE(picture_named("\u0436.obj").rgba, picture_named("\u0448.obj").rgba) << "Cyrillic";
  EXPECT_NE(picture_named("\u2312.obj").rgba, picture_named("\u2313.obj").rgba)
      << "symbols of a font that fontconfig finds";
  EXPECT_EQ(picture_named("\xff.obj").rgba, picture_named("\x80.obj").rgba) << "not UTF-8";
}

TEST(Panels, ChineseNamesAreShown) {
  CodePoints hare;
  hare.add_text("\u5154\u72d0");
  ASSERT_FALSE(find_faces(hare).empty()) << "no font has Chinese glyphs (scripts/bootstrap test)";
  EXPECT_NE(picture_named("\u5154.obj").rgba, picture_named("\u72d0.obj").rgba);
}

}  // namespace
}  // namespace mesher::app
