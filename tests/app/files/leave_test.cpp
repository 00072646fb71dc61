#include "app/files/leave.h"

#include <gtest/gtest.h>

#include "app/document/tabs.h"
#include "app/files/browse.h"
#include "engine/io/read.h"
#include "tests/app/edit/editing.h"
#include "tests/support/temp_folder.h"

namespace mesher::app {
namespace {

class LeaveTest : public testing::Test {
 protected:
  void save(const std::filesystem::path& file) {
    set_text(s_.saving.browser, file.string());
    submit_save(s_.saving, s_.document);
    ASSERT_EQ(s_.saving.browser.problem, "");
    run_waiting_save(s_);
  }

  void open_another(Soup soup, const char* name) {
    add_tab(s_);
    Model model;
    model.mesh = build_mesh(std::move(soup)).mesh;
    show_model(s_, std::move(model), name);
  }

  test::TempFolder folder_;
  Session s_ = session_with(test::torus(20, 10));
};

TEST_F(LeaveTest, LeavesAtOnceWithoutEdits) {
  request_leave(s_, Leaving::quit);
  EXPECT_FALSE(has_question(s_));
  EXPECT_TRUE(s_.wants_quit);
}

TEST_F(LeaveTest, ClosingTheOnlyModelLeavesTheStartScreen) {
  s_.document.simplify.rules.seed = 7;
  const std::uint64_t generation = s_.document.model_generation;
  request_leave(s_, Leaving::close);
  EXPECT_FALSE(s_.wants_quit);
  EXPECT_TRUE(s_.shows_start);
  EXPECT_EQ(s_.document.statistics.faces, 0U);
  EXPECT_GT(s_.document.model_generation, generation);
  EXPECT_EQ(s_.document.simplify.rules.seed, 7U);
  press(s_, "d s c w g p c f ctrl+z ctrl+y k shift+d");
  EXPECT_EQ(s_.document.statistics.faces, 0U) << "no command needs a model";
  open_another(test::cube(), "second.obj");
  EXPECT_EQ(tab_count(s_), 1U);
}

TEST_F(LeaveTest, AsksWithEditsAndCancelKeepsThem) {
  press(s_, "d");
  request_leave(s_, Leaving::quit);
  EXPECT_TRUE(has_question(s_));
  EXPECT_FALSE(s_.wants_quit);
  answer_leave(s_, LeaveAnswer::cancel);
  EXPECT_FALSE(has_question(s_));
  EXPECT_FALSE(s_.wants_quit);
  EXPECT_TRUE(has_unsaved_edits(s_.document));
  request_leave(s_, Leaving::close);
  EXPECT_TRUE(has_question(s_));
  answer_leave(s_, LeaveAnswer::discard);
  EXPECT_FALSE(has_unsaved_edits(s_.document));
  EXPECT_TRUE(s_.shows_start);
}

TEST_F(LeaveTest, QuitAsksForEachModel) {
  press(s_, "d");
  open_another(test::cube(), "second.obj");
  open_another(test::tetrahedron(), "third.obj");
  press(s_, "s");
  open_another(test::cube(), "fourth.obj");
  request_leave(s_, Leaving::quit);
  EXPECT_EQ(s_.document.file, "model.obj") << "the question is about the shown model";
  ASSERT_TRUE(has_question(s_));
  answer_leave(s_, LeaveAnswer::cancel);
  EXPECT_EQ(tab_count(s_), 4U);
  request_leave(s_, Leaving::quit);
  answer_leave(s_, LeaveAnswer::discard);
  EXPECT_EQ(s_.document.file, "third.obj");
  ASSERT_TRUE(has_question(s_));
  EXPECT_FALSE(s_.wants_quit);
  answer_leave(s_, LeaveAnswer::save);
  save(folder_ / "third.obj");
  EXPECT_TRUE(s_.wants_quit);
}

TEST_F(LeaveTest, CloseShowsTheNextModel) {
  open_another(test::cube(), "second.obj");
  press(s_, "d");
  request_leave(s_, Leaving::close);
  ASSERT_TRUE(has_question(s_));
  answer_leave(s_, LeaveAnswer::discard);
  EXPECT_EQ(s_.document.file, "model.obj");
  EXPECT_EQ(tab_count(s_), 1U);
  EXPECT_FALSE(s_.wants_quit);
}

TEST_F(LeaveTest, SavedModelInAnotherTabCounts) {
  press(s_, "d");
  s_.saving.waiting = folder_ / "a.ply";
  const auto task = begin_save(s_.saving, s_.document);
  open_another(test::cube(), "second.obj");
  note_saved(s_, perform(*task));
  EXPECT_FALSE(has_unsaved_edits(document_of(s_, 0)));
  EXPECT_NE(s_.document.notice.find("saved"), std::string::npos);
}

TEST_F(LeaveTest, UndoneAndSavedEditsAreNotUnsaved) {
  press(s_, "d");
  EXPECT_TRUE(has_unsaved_edits(s_.document));
  press(s_, "ctrl+z");
  EXPECT_FALSE(has_unsaved_edits(s_.document));
  press(s_, "ctrl+y");
  EXPECT_TRUE(has_unsaved_edits(s_.document));
  save(folder_ / "a.ply");
  EXPECT_FALSE(has_unsaved_edits(s_.document));
  press(s_, "ctrl+z");
  EXPECT_TRUE(has_unsaved_edits(s_.document)) << "the file has the edit, the model has not";
  press(s_, "d");
  EXPECT_TRUE(has_unsaved_edits(s_.document)) << "equal edits are not the same edit";
}

TEST_F(LeaveTest, RequestedEditIsUnsaved) {
  request_subdivide(s_.document);
  EXPECT_TRUE(has_unsaved_edits(s_.document));
  request_undo(s_.document);
  run_waiting_edits(s_.document);
  EXPECT_FALSE(has_unsaved_edits(s_.document));
}

TEST_F(LeaveTest, SaveLeavesOnceTheFileIsWritten) {
  press(s_, "d");
  request_leave(s_, Leaving::quit);
  answer_leave(s_, LeaveAnswer::save);
  EXPECT_TRUE(s_.saving.shows_dialog);
  EXPECT_FALSE(s_.wants_quit);
  save(folder_ / "a.ply");
  EXPECT_TRUE(s_.wants_quit);
  EXPECT_EQ(io::read_model(folder_ / "a.ply").mesh.face_count(), s_.document.statistics.faces);
}

TEST_F(LeaveTest, SaveInProgressiveModeWritesTheModel) {
  press(s_, "d p home");
  ASSERT_TRUE(s_.document.progressive.is_on());
  request_leave(s_, Leaving::quit);
  answer_leave(s_, LeaveAnswer::save);
  save(folder_ / "a.ply");
  EXPECT_TRUE(s_.wants_quit);
  EXPECT_EQ(io::read_model(folder_ / "a.ply").mesh.face_count(), s_.document.statistics.faces);
}

TEST_F(LeaveTest, FormatThatLosesCreasesAsksAgain) {
  s_.document.creases.tag_angle_deg = 1.0F;
  press(s_, "shift+c");
  ASSERT_GT(s_.document.statistics.crease_edges, 0U);
  request_leave(s_, Leaving::quit);
  answer_leave(s_, LeaveAnswer::save);
  save(folder_ / "a.stl");
  EXPECT_FALSE(s_.wants_quit);
  EXPECT_TRUE(has_question(s_));
  EXPECT_NE(s_.document.notice.find("does not hold"), std::string::npos) << s_.document.notice;
}

TEST_F(LeaveTest, ClosedSaveDialogStays) {
  press(s_, "d");
  request_leave(s_, Leaving::quit);
  answer_leave(s_, LeaveAnswer::save);
  press(s_, "esc");
  EXPECT_FALSE(s_.saving.shows_dialog);
  run(s_, "save_file");
  save(folder_ / "a.ply");
  EXPECT_FALSE(s_.wants_quit) << "this file was not written to leave";
}

TEST_F(LeaveTest, FileOfAnEarlierModelDoesNotCount) {
  press(s_, "d");
  s_.saving.waiting = folder_ / "a.ply";
  const auto task = begin_save(s_.saving, s_.document);
  show_model(s_, Model{s_.document.model}, "other.obj");
  press(s_, "d");
  note_saved(s_, perform(*task));
  EXPECT_TRUE(has_unsaved_edits(s_.document));
}

TEST_F(LeaveTest, KeysAnswer) {
  press(s_, "d q");
  ASSERT_TRUE(has_question(s_));
  for (const char* letter : {"w", "d", "q", "enter", "space"}) {
    answer_question(s_, {.name = letter});
    EXPECT_TRUE(has_question(s_)) << letter << " does not answer the question";
  }
  answer_question(s_, {.name = "escape"});
  EXPECT_FALSE(has_question(s_));
  press(s_, "q");
  answer_question(s_, {.name = "s"});
  EXPECT_TRUE(s_.saving.shows_dialog);
  press(s_, "q");
  EXPECT_FALSE(s_.saving.shows_dialog);
  answer_question(s_, {.name = "delete"});
  EXPECT_TRUE(s_.wants_quit);
}

}  // namespace
}  // namespace mesher::app
