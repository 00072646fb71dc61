#include "app/ui/panels.h"

#include <gtest/gtest.h>
#include <imgui.h>

#include <algorithm>
#include <string>
#include <vector>

#include "app/cli/view.h"
#include "app/input/keys.h"
#include "app/ui/font_finder.h"
#include "app/viewer/scripted_session.h"
#include "tests/support/golden.h"
#include "tests/support/gpu_test.h"

namespace mesher::app {
namespace {

struct Shot {
  const char* name;
  glm::dvec2 window;
  float scale;
  const char* keys;
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

Session open_knot(const Shot& shot) {
  Session session;
  session.view.window = shot.window;
  set_default_view(session.view.camera);
  open_whole(session, {.model = MESHER_SOURCE_DIR "/assets/knot.obj"}, {.quiet = true});
  session.shows_info = fits_docks(shot.window, shot.scale);
  return session;
}

bool overlap(const glm::vec4& a, const glm::vec4& b) {
  return std::min(a.z, b.z) - std::max(a.x, b.x) > 1.0F &&
         std::min(a.w, b.w) - std::max(a.y, b.y) > 1.0F;
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

class PanelsOf : public test::GpuTest, public testing::WithParamInterface<Shot> {};

TEST_P(PanelsOf, WindowLooksAsItsGolden) {
  const Shot& shot = GetParam();
  Session session = open_knot(shot);
  ScriptedSession script(
      session, {.device = "", .validation = true, .panels = true, .ui_scale = shot.scale});
  script.press(parse_keys(shot.keys));
  forget_times(session.document.edits);
  const Image picture = script.picture();
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
