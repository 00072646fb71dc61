#include "app/files/open.h"

#include <gtest/gtest.h>

#include "app/files/browse.h"
#include "app/input/commands.h"
#include "tests/app/edit/editing.h"
#include "tests/support/temp_folder.h"

namespace mesher::app {
namespace {

class OpenTest : public testing::Test {
 protected:
  void submit_typed(const std::string& text) {
    set_text(dialog().browser, text);
    submit_open(s_, {});
  }
  OpenDialog& dialog() { return s_.open_dialog; }

  test::TempFolder folder_;
  std::filesystem::path file_ = folder_.write("a.obj", "");
  Session s_ = session_with(test::cube());
};

TEST_F(OpenTest, DialogStaysUntilTheFileIsRead) {
  run(s_, "open_file");
  submit_typed(file_.string());
  EXPECT_EQ(s_.wants_open, std::vector<std::filesystem::path>{file_});
  EXPECT_TRUE(dialog().is_shown);
  submit_typed(file_.string());
  EXPECT_EQ(s_.wants_open.size(), 1U) << "it is being opened";
  note_opened(s_, file_);
  EXPECT_FALSE(dialog().is_shown);
  EXPECT_EQ(s_.preferences.recent.front(), file_);
  run(s_, "open_file");
  EXPECT_EQ(dialog().browser.folder, folder_.path()) << "where the last file was";
}

TEST_F(OpenTest, FailureStaysInTheDialogWithTheText) {
  run(s_, "open_file");
  submit_typed(file_.string());
  note_not_opened(s_, {"a.obj:1: it is empty"});
  EXPECT_TRUE(dialog().is_shown);
  EXPECT_EQ(dialog().browser.problem, "a.obj:1: it is empty");
  EXPECT_EQ(dialog().browser.typed, file_.string());
  EXPECT_EQ(s_.document.error, "");
  submit_typed("none");
  EXPECT_NE(dialog().browser.problem.find("there is no file"), std::string::npos);
  EXPECT_EQ(s_.wants_open.size(), 1U);
}

TEST_F(OpenTest, FailureWithoutDialogIsTheDocumentsError) {
  note_not_opened(s_, {"a: bad", "b: bad"});
  EXPECT_EQ(s_.document.error, "a: bad\nb: bad");
  note_not_opened(s_, std::vector<std::string>(100, "x: bad"));
  EXPECT_EQ(s_.document.error,
            "x: bad\nx: bad\nx: bad\nx: bad\nx: bad\nand 95 more files could "
            "not be opened");
}

TEST_F(OpenTest, AnotherFileDoesNotCloseTheDialog) {
  run(s_, "open_file");
  submit_typed(file_.string());
  note_opened(s_, folder_ / "dropped.obj");
  EXPECT_TRUE(dialog().is_shown);
}

TEST_F(OpenTest, StartScreenEndsWithTheFirstFile) {
  s_.shows_start = true;
  request_open(s_, file_);
  EXPECT_TRUE(s_.shows_start);
  note_opened(s_, file_);
  EXPECT_FALSE(s_.shows_start);
  s_.shows_start = true;
  run(s_, "escape");
  EXPECT_FALSE(s_.shows_start);
}

}  // namespace
}  // namespace mesher::app
