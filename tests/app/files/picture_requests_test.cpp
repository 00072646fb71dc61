#include "app/files/picture_requests.h"

#include <gtest/gtest.h>

#include "app/files/browse.h"
#include "app/input/commands.h"
#include "engine/io/png.h"
#include "tests/app/edit/editing.h"
#include "tests/support/temp_folder.h"

namespace mesher::app {
namespace {

class PictureRequestsTest : public testing::Test {
 protected:
  PictureRequestsTest() {
    s_.preferences.picture_folder = folder_.path();
    s_.view.window = {80, 60};
    run(s_, "frame_model");
    run(s_, "picture");
  }
  const std::string& submit_typed(const std::string& text) {
    set_text(dialog().browser, text);
    submit_picture(s_, {});
    return dialog().browser.problem;
  }
  PictureDialog& dialog() { return s_.picture; }

  test::TempFolder folder_;
  Session s_ = session_with(test::cube());
};

TEST_F(PictureRequestsTest, DialogSuggestsANewNameInTheLastFolder) {
  EXPECT_TRUE(dialog().is_shown);
  EXPECT_EQ(dialog().browser.folder, folder_.path());
  const std::string name = dialog().browser.typed;
  EXPECT_TRUE(name.ends_with(".png")) << name;
  folder_.write(name, "");
  run(s_, "picture");
  EXPECT_NE(dialog().browser.typed, name);
  run(s_, "escape");
  EXPECT_FALSE(dialog().is_shown);
}

TEST_F(PictureRequestsTest, PictureHasTheChosenSize) {
  dialog().options.scale = 3;
  EXPECT_EQ(submit_typed("big.png"), "");
  EXPECT_FALSE(dialog().is_shown);
  std::optional<PictureTask> task = begin_requested_picture(s_);
  ASSERT_TRUE(task);
  EXPECT_FALSE(begin_requested_picture(s_)) << "requested once";
  perform(*task, nullptr);
  const Image image = io::read_png(folder_ / "big.png");
  EXPECT_EQ(image.width, 240U);
  EXPECT_EQ(image.height, 180U);
}

TEST_F(PictureRequestsTest, ProblemsStayInTheDialog) {
  EXPECT_EQ(submit_typed(""), "enter a file name");
  EXPECT_NE(submit_typed("a.jpg"), "");
  EXPECT_EQ(submit_typed("none/a.png"), "there is no folder " + (folder_ / "none").string());
  folder_.write("mine.png", "mine");
  EXPECT_EQ(submit_typed("mine.png"), "mine.png already exists; press Enter again to overwrite it");
  EXPECT_TRUE(dialog().is_shown);
  EXPECT_FALSE(dialog().waiting);
  EXPECT_EQ(submit_typed("mine.png"), "");
  EXPECT_TRUE(dialog().waiting);
}

TEST_F(PictureRequestsTest, TurntableChangesTheEnding) {
  set_text(dialog().browser, "turn.png");
  choose_turn(dialog(), true);
  EXPECT_EQ(dialog().browser.typed, "turn.webp");
  EXPECT_EQ(submit_typed("turn_###.png"), "");
  const std::optional<PictureTask> task = begin_requested_picture(s_);
  ASSERT_TRUE(task && task->request.turn);
  EXPECT_EQ(task->request.turn->frames, 72U);
  run(s_, "picture");
  EXPECT_TRUE(dialog().browser.typed.ends_with(".webp")) << "the choice is kept";
  folder_.write("turn_000.png", "");
  EXPECT_EQ(submit_typed("turn_###.png"),
            "turn_000.png already exists; press Enter again to overwrite it");
}

TEST_F(PictureRequestsTest, ListShowsPictures) {
  folder_.write("a.png", "");
  folder_.write("b.webp", "");
  folder_.write("c.obj", "");
  const Folder folder = read_folder(folder_.path());
  EXPECT_EQ(shown_entries(folder, dialog().browser.filter).size(), 2U);
}

}  // namespace
}  // namespace mesher::app
