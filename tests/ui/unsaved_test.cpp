// Tests in a real window that no edit is lost without a question, and that edits outlive a kill.
#include <gtest/gtest.h>

#include <filesystem>

#include "engine/io/read.h"
#include "tests/support/temp_folder.h"
#include "tests/ui/window_fixture.h"
#include "tests/ui/xdnd_source.h"

namespace mesher::test {
namespace {

class UnsavedTest : public WindowTest {};

TEST_F(UnsavedTest, CloseButtonAsksAndEveryAnswerWorks) {
  const auto v = open({"knot", "--size", "800x600"});
  EXPECT_EQ(v->title().substr(0, 8), "knot.obj");
  v->key("d");
  EXPECT_REACHES(*v, s["unsaved"] == true && s["undo_depth"] == 1);
  v->settle();
  EXPECT_EQ(v->title().substr(0, 9), "*knot.obj");
  v->press_close_button();
  EXPECT_REACHES(*v, s["question"] == "unsaved");
  v->key("Escape");
  EXPECT_REACHES(*v, s["question"].is_null() && s["undo_depth"] == 1);
  v->press_close_button();
  EXPECT_REACHES(*v, s["question"] == "unsaved");
  v->key("s");
  EXPECT_REACHES(*v, s["save_dialog"] == true && s["question"].is_null());
  v->settle();
  const std::filesystem::path file = v->folder() / "kept.ply";
  server_->xdotool({"type", "--delay", "60", file.string()});
  v->settle();
  v->key("Return");
  EXPECT_EQ(v->wait_for_end(), 0) << v->state().dump(2);
  EXPECT_EQ(io::read_model(file).mesh.face_count(), 2592U);
}

TEST_F(UnsavedTest, QuitsAtOnceWithoutEdits) {
  const auto v = open({"knot", "--size", "800x600"});
  v->key("d");
  EXPECT_REACHES(*v, s["undo_depth"] == 1);
  v->key("ctrl+z");
  EXPECT_REACHES(*v, s["undo_depth"] == 0 && s["unsaved"] == false);
  v->press_close_button();
  EXPECT_EQ(v->wait_for_end(), 0);
}

TEST_F(UnsavedTest, DropKeepsEditsAndClosingAsks) {
  const auto v = open({"cube", "--size", "800x600"});
  v->key("s");
  EXPECT_REACHES(*v, s["faces"] == 48);
  const unsigned long window = std::stoul(v->window());
  ASSERT_TRUE(drop_file(server_->display(), window, MESHER_SOURCE_DIR "/assets/knot.obj"));
  EXPECT_REACHES(*v, s["faces"] == 2880 && s["unsaved"] == false);
  EXPECT_EQ(v->state()["tabs"], json::array({"cube.obj", "knot.obj"}));
  v->key("q");
  EXPECT_REACHES(*v, s["question"] == "unsaved" && s["faces"] == 48);
  v->key("w");  // keys do nothing but answer
  v->key("Escape");
  EXPECT_REACHES(*v, s["question"].is_null());
  EXPECT_EQ(v->state()["faces"], 48);
  EXPECT_EQ(v->state()["wireframe"], false);
  v->key("ctrl+w");
  EXPECT_REACHES(*v, s["question"] == "unsaved");
  v->key("Delete");
  EXPECT_REACHES(*v, s["faces"] == 2880 && s["tabs"].size() == 1);
  v->key("ctrl+w");  // the last model
  EXPECT_REACHES(*v, s["start"] == true && s["faces"] == 0);
  quit(*v);
}

TEST_F(UnsavedTest, EditsOfEveryTabOutliveAKill) {
  const TempFolder home;
  {
    const auto v = open({"knot", "--size", "800x600"}, home.path());
    v->key("d");
    EXPECT_REACHES(*v, s["undo_depth"] == 1);
    const unsigned long window = std::stoul(v->window());
    ASSERT_TRUE(drop_file(server_->display(), window, MESHER_SOURCE_DIR "/assets/cube.obj"));
    EXPECT_REACHES(*v, s["faces"] == 12);
    v->key("s");
    EXPECT_REACHES(*v, s["undo_depth"] == 1 && s["faces"] == 48);
    v->settle();
    v->kill();
  }
  const auto v = open({"hypersheet", "--size", "800x600"}, home.path());
  EXPECT_REACHES(*v, s["question"] == "lost");
  v->key("r");
  EXPECT_REACHES(*v, s["tabs"].size() == 2 && s["undo_depth"] == 1);
  EXPECT_REACHES(*v, s["question"] == "lost");
  v->key("r");
  EXPECT_REACHES(*v, s["tabs"].size() == 3 && s["undo_depth"] == 1 && s["question"].is_null());
  v->key("q");
  EXPECT_REACHES(*v, s["question"] == "unsaved");
  v->key("Delete");
  EXPECT_REACHES(*v, s["tabs"].size() == 2 && s["question"] == "unsaved");
  v->key("Delete");
  EXPECT_EQ(v->wait_for_end(), 0);
}

TEST_F(UnsavedTest, EditsOutliveAKill) {
  const TempFolder home;
  json edited;
  {
    const auto v = open({"knot", "--size", "800x600"}, home.path());
    v->key("d");
    EXPECT_REACHES(*v, s["undo_depth"] == 1);
    v->key("s");
    EXPECT_REACHES(*v, s["undo_depth"] == 2);
    v->key("d");
    EXPECT_REACHES(*v, s["undo_depth"] == 3);
    v->key("ctrl+z");
    EXPECT_REACHES(*v, s["undo_depth"] == 2 && s["redo_depth"] == 1);
    edited = v->state();
    v->settle();
    v->kill();
  }
  {
    const auto v = open({"cube", "--size", "800x600"}, home.path());
    EXPECT_REACHES(*v, s["question"] == "lost");
    v->key("Escape");  // later
    EXPECT_REACHES(*v, s["question"].is_null());
    quit(*v);
  }
  {
    const auto v = open({"cube", "--size", "800x600"}, home.path());
    EXPECT_REACHES(*v, s["question"] == "lost");
    v->key("r");
    EXPECT_REACHES(*v, s["undo_depth"] == 2 && s["redo_depth"] == 1);
    EXPECT_EQ(v->state()["faces"], edited["faces"]);
    EXPECT_EQ(v->state()["file"], edited["file"]);
    EXPECT_EQ(v->state()["unsaved"], true);
    v->settle();
    v->kill();
  }
  {
    const auto v = open({"cube", "--size", "800x600"}, home.path());
    EXPECT_REACHES(*v, s["question"] == "lost");
    v->key("d");  // does not answer the question
    v->key("Delete");
    EXPECT_REACHES(*v, s["question"].is_null());
    quit(*v);
  }
  const auto v = open({"cube", "--size", "800x600"}, home.path());
  v->settle();
  EXPECT_TRUE(v->state()["question"].is_null());
  EXPECT_TRUE(std::filesystem::is_empty(home.path() / "mesher"));
  quit(*v);
}

}  // namespace
}  // namespace mesher::test
