#include "app/files/paths.h"

#include <gtest/gtest.h>

#include <cstdlib>

#include "tests/support/temp_folder.h"

namespace mesher::app {
namespace {

TEST(Paths, BareNameIsSearchedForInAssets) {
  EXPECT_EQ(find_model("cube.obj").parent_path().filename(), "assets");
  EXPECT_EQ(find_model("cube").filename(), "cube.obj");
  EXPECT_EQ(find_model("no_such_model.obj"), "no_such_model.obj");
  EXPECT_EQ(find_model("./cube.obj"), "./cube.obj");  // names with a folder are not searched for
}

TEST(Paths, ExistingFileTakesPrecedenceOverAssets) {
  const test::TempFolder folder;
  const auto file = folder.write("cube.obj", "");
  EXPECT_EQ(find_model(file.string()), file);
}

TEST(Paths, ScreenshotsDoNotOverwriteOneAnother) {
  const test::TempFolder folder;
  setenv("XDG_PICTURES_DIR", folder.path().c_str(), 1);
  const auto first = next_screenshot("bunny.obj");
  EXPECT_EQ(first, folder / "mesher-bunny.png");
  folder.write("mesher-bunny.png", "");
  EXPECT_EQ(next_screenshot("bunny.obj"), folder / "mesher-bunny-2.png");
  unsetenv("XDG_PICTURES_DIR");
}

TEST(Paths, HomeThatIsMissingOrRelativeIsNone) {
  const char* old = std::getenv("HOME");
  const std::string home = old == nullptr ? "" : old;
  unsetenv("XDG_STATE_HOME");
  unsetenv("XDG_CONFIG_HOME");
  for (const char* none : {"", "relative/home"}) {
    setenv("HOME", none, 1);
    EXPECT_EQ(state_folder(), "");
    EXPECT_EQ(config_folder(), "");
  }
  unsetenv("HOME");
  EXPECT_EQ(state_folder(), "");
  EXPECT_EQ(home_folder(), "");
  setenv("HOME", home.c_str(), 1);
}

TEST(Paths, NearestFolderOfADeletedOne) {
  const test::TempFolder folder;
  EXPECT_EQ(nearest_folder(folder.path()), folder.path());
  EXPECT_EQ(nearest_folder(folder / "deleted/below"), folder.path());
  EXPECT_EQ(nearest_folder("/no_such_folder"), "/");
  EXPECT_EQ(nearest_folder("deleted/below"), ".");
  EXPECT_EQ(nearest_folder(""), ".");
}

TEST(Paths, FoldersAreMadeOrTheReasonIsSaid) {
  const test::TempFolder folder;
  make_folder(folder / "a/b");
  make_folder(folder / "a/b");
  EXPECT_TRUE(is_folder(folder / "a/b"));
  const std::string below = folder.write("file", "").string() + "/below";
  try {
    make_folder(below);
    ADD_FAILURE();
  } catch (const OutputError& error) {
    EXPECT_EQ(std::string(error.what()), below + ": cannot make the folder: Not a directory");
  }
}

TEST(Paths, TypedPathIsStrippedOfBlanksAndQuotes) {
  EXPECT_EQ(typed_path("  'a b.obj' "), "a b.obj");
  EXPECT_EQ(typed_path(" \t"), "");
  setenv("HOME", "/somewhere", 1);
  EXPECT_EQ(typed_path("~/x.obj"), "/somewhere/x.obj");
}

}  // namespace
}  // namespace mesher::app
