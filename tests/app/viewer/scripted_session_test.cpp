#include "app/viewer/scripted_session.h"

#include <gtest/gtest.h>

#include <cstdlib>

#include "engine/core/error.h"
#include "engine/io/png.h"
#include "tests/support/meshes.h"
#include "tests/support/temp_folder.h"

namespace mesher::app {
namespace {

class ScriptedSessionTest : public testing::Test {
 protected:
  ScriptedSessionTest() {
    session_.view.window = {160, 120};
    set_default_view(session_.view.camera);
    show(test::cube());
  }
  void show(Soup soup) {
    Model model;
    model.name = "cube.obj";
    model.mesh = build_mesh(std::move(soup)).mesh;
    show_model(session_, std::move(model), "cube.obj");
  }

  Session session_;
  ScriptedSession script_{session_, {.device = "", .validation = true}};
};

TEST_F(ScriptedSessionTest, PicturesFollowKeys) {
  const Image flat = script_.picture();
  EXPECT_EQ(flat.width, 160U);
  EXPECT_EQ(flat.height, 120U);
  script_.press(parse_keys("w"));
  const Image lines = script_.picture();
  EXPECT_NE(flat.rgba, lines.rgba);
  script_.press(parse_keys("w"));
  EXPECT_EQ(script_.picture().rgba, flat.rgba);
  script_.expect_no_messages();
}

TEST_F(ScriptedSessionTest, AnotherModelGivesAnotherPicture) {
  const Image cube = script_.picture();
  show(test::torus(20, 10));
  EXPECT_NE(script_.picture().rgba, cube.rgba);
  script_.expect_no_messages();
}

TEST_F(ScriptedSessionTest, ScreenshotKeyWritesShownPicture) {
  const test::TempFolder folder;
  setenv("XDG_PICTURES_DIR", folder.path().c_str(), 1);
  script_.press(parse_keys("g f12"));
  unsetenv("XDG_PICTURES_DIR");
  EXPECT_EQ(io::read_png(folder / "mesher-cube.png").rgba, script_.picture().rgba);
  EXPECT_NE(session_.document.notice.find("mesher-cube.png"), std::string::npos);
}

TEST_F(ScriptedSessionTest, StopsAtQuitAndRejectsUnboundKeys) {
  script_.press(parse_keys("q w"));
  EXPECT_FALSE(session_.view.settings.wireframe);
  EXPECT_THROW(script_.press(parse_keys("f9")), UsageError);
}

TEST_F(ScriptedSessionTest, EditsRunBeforeNextKey) {
  show(test::torus(12, 10));
  const Image full = script_.picture();
  script_.press(parse_keys("d d"));
  EXPECT_LE(session_.document.statistics.faces, 195U);
  EXPECT_EQ(session_.document.edits.history.undo_depth(), 2U);
  EXPECT_NE(script_.picture().rgba, full.rgba);
  script_.press(parse_keys("ctrl+z ctrl+z"));
  EXPECT_EQ(script_.picture().rgba, full.rgba);
  script_.expect_no_messages();
}

TEST_F(ScriptedSessionTest, CreasesAndSelectionAreDrawn) {
  const Image plain = script_.picture();
  script_.press(parse_keys("shift+c"));
  EXPECT_EQ(script_.picture().rgba, plain.rgba) << "neither the mode nor the wireframe is on";
  script_.press(parse_keys("c"));
  const Image creases = script_.picture();
  EXPECT_NE(creases.rgba, plain.rgba);
  script_.press(parse_keys("ctrl+a"));
  const Image selection = script_.picture();
  EXPECT_NE(selection.rgba, creases.rgba);
  script_.press(parse_keys("- - -"));
  const Image weaker = script_.picture();
  EXPECT_NE(weaker.rgba, selection.rgba);
  script_.press(parse_keys("ctrl+z ctrl+z ctrl+z"));
  EXPECT_EQ(script_.picture().rgba, selection.rgba);
  script_.press(parse_keys("esc"));
  EXPECT_EQ(script_.picture().rgba, creases.rgba);
  script_.press(parse_keys("ctrl+a d c"));  // the edges have changed: the selection is cleared
  EXPECT_TRUE(session_.document.creases.selected.empty());
  script_.expect_no_messages();
}

TEST(ScriptedSession, UnknownDeviceThrows) {
  Session session;
  ScriptedSession script(session, {.device = "no such device", .validation = false});
  EXPECT_THROW((void)script.picture(), DeviceError);
}

}  // namespace
}  // namespace mesher::app
