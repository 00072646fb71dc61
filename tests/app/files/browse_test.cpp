#include "app/files/browse.h"

#include <gtest/gtest.h>

#include "app/files/paths.h"
#include "tests/support/temp_folder.h"

namespace mesher::app {
namespace {

namespace fs = std::filesystem;

class BrowseTest : public testing::Test {
 protected:
  BrowseTest() {
    fs::create_directory(folder_ / "models");
    folder_.write("models/teapot.obj", "");
    folder_.write("bunny.obj", "");
    folder_.write("bunny_1k.obj", "");
    folder_.write("dragon.ply", "");
    browser_.searches = true;
    go_to(browser_, folder_.path());
  }
  void type(const std::string& text) {
    browser_.typed = text;
    follow_text(browser_);
  }
  std::vector<const FolderEntry*> shown() {
    listed_ = read_folder(shown_folder(browser_));
    return shown_entries(listed_, browser_.filter);
  }
  std::optional<fs::path> submit_typed(const std::string& text) {
    type(text);
    return submit(browser_, shown());
  }

  test::TempFolder folder_;
  Folder listed_;
  FileBrowser browser_;
};

TEST_F(BrowseTest, TypedPathIsFollowed) {
  EXPECT_EQ(shown().size(), 4U);
  type("models/");
  EXPECT_EQ(shown_folder(browser_), folder_ / "models");
  EXPECT_EQ(shown().size(), 1U);
  type((folder_ / "models" / "tea").string());
  EXPECT_EQ(shown_folder(browser_), folder_ / "models");
  EXPECT_EQ(shown().size(), 1U);
  type("../");
  EXPECT_EQ(shown_folder(browser_), folder_.path().parent_path());
  type("");
  EXPECT_EQ(shown_folder(browser_), folder_.path());
}

TEST_F(BrowseTest, EnterOpensWhatIsTyped) {
  EXPECT_EQ(submit_typed("bunny.obj"), folder_ / "bunny.obj");
  EXPECT_EQ(submit_typed("models/teapot.obj"), folder_ / "models/teapot.obj");
  EXPECT_EQ(submit_typed("'" + (folder_ / "dragon.ply").string() + "'"), folder_ / "dragon.ply");
  EXPECT_EQ(submit_typed("drag"), folder_ / "dragon.ply") << "the only name that matches";
  EXPECT_EQ(submit_typed("cactus"), samples_folder() / "cactus.obj");
  EXPECT_EQ(submit_typed(""), std::nullopt);
  EXPECT_EQ(browser_.problem, "");
}

TEST_F(BrowseTest, EnterKeepsTheTextOfAMistake) {
  EXPECT_EQ(submit_typed("none.obj"), std::nullopt);
  EXPECT_EQ(browser_.problem, "there is no file " + (folder_ / "none.obj").string());
  EXPECT_EQ(browser_.typed, "none.obj");
  EXPECT_EQ(submit_typed("bun"), std::nullopt);
  EXPECT_NE(browser_.problem.find("2 names match"), std::string::npos) << browser_.problem;
  type("bunn");
  EXPECT_EQ(browser_.problem, "") << "it is about another text";
}

TEST_F(BrowseTest, EnterGoesToAFolder) {
  EXPECT_EQ(submit_typed("models"), std::nullopt);
  EXPECT_EQ(browser_.folder, folder_ / "models");
  EXPECT_EQ(browser_.typed, "");
  EXPECT_EQ(submit_typed(".."), std::nullopt);
  EXPECT_EQ(browser_.folder, folder_.path());
}

TEST_F(BrowseTest, ArrowKeysChooseARow) {
  auto rows = shown();
  move_row(browser_, 1, rows.size());
  EXPECT_EQ(browser_.row, 0);
  move_row(browser_, 1, rows.size());
  EXPECT_EQ(submit(browser_, rows), folder_ / "bunny.obj");
  move_row(browser_, 99, rows.size());
  EXPECT_EQ(browser_.row, 3) << "stays in the list";
  move_row(browser_, -99, rows.size());
  EXPECT_EQ(browser_.row, 0);
  EXPECT_EQ(submit(browser_, rows), std::nullopt) << "a folder";
  EXPECT_EQ(browser_.folder, folder_ / "models");
  EXPECT_FALSE(browser_.row);
  move_row(browser_, 1, 0);
  EXPECT_FALSE(browser_.row) << "the list is empty";
}

TEST_F(BrowseTest, ChosenFileDoesNotFilterTheList) {
  const auto rows = shown();
  choose(browser_, *rows[1]);
  EXPECT_EQ(browser_.typed, "bunny.obj");
  EXPECT_EQ(shown().size(), 4U);
}

TEST_F(BrowseTest, SaveDialogDoesNotFilter) {
  browser_.searches = false;
  type("new.obj");
  EXPECT_EQ(shown().size(), 4U);
}

TEST_F(BrowseTest, TabCompletesAsFarAsNamesAgree) {
  const auto complete = [&](const std::string& text) {
    type(text);
    return completed_text(text, shown());
  };
  EXPECT_EQ(complete("bu"), "bunny");
  EXPECT_EQ(complete("bunny."), "bunny.obj");
  EXPECT_EQ(complete("mo"), "models/");
  EXPECT_EQ(complete("models/t"), "models/teapot.obj");
  EXPECT_EQ(complete("zzz"), "zzz");
  EXPECT_EQ(complete((folder_ / "DRA").string()), (folder_ / "dragon.ply").string());
}

}  // namespace
}  // namespace mesher::app
