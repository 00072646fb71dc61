#include "app/files/folder.h"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <chrono>

#include "app/files/paths.h"
#include "tests/support/temp_folder.h"

namespace mesher::app {
namespace {

namespace fs = std::filesystem;

class FolderTest : public testing::Test {
 protected:
  FolderTest() {
    fs::create_directory(folder_ / "models");
    fs::create_directory(folder_ / ".cache");
    folder_.write("Bunny.OBJ", std::string(30, 'x'));
    folder_.write("armadillo.ply", std::string(20, 'x'));
    folder_.write("bunny_1k.obj", std::string(10, 'x'));
    folder_.write("notes.txt", "x");
    folder_.write(".hidden.obj", "x");
    const auto now = fs::file_time_type::clock::now();
    fs::last_write_time(folder_ / "Bunny.OBJ", now - std::chrono::hours(3));
    fs::last_write_time(folder_ / "armadillo.ply", now - std::chrono::hours(2));
    fs::last_write_time(folder_ / "bunny_1k.obj", now - std::chrono::hours(1));
  }
  std::vector<std::string> names(const FolderFilter& filter) const {
    const Folder folder = read_folder(folder_.path());
    std::vector<std::string> names;
    for (const FolderEntry* entry : shown_entries(folder, filter))
      names.push_back(entry->name);
    return names;
  }
  using Names = std::vector<std::string>;

  test::TempFolder folder_;
};

TEST_F(FolderTest, FoldersComeFirstAndCaseDoesNotMatter) {
  EXPECT_EQ(names({}), (Names{"models", "armadillo.ply", "Bunny.OBJ", "bunny_1k.obj"}));
  EXPECT_EQ(names({.is_descending = true}),
            (Names{"models", "bunny_1k.obj", "Bunny.OBJ", "armadillo.ply"}));
}

TEST_F(FolderTest, SortsBySizeAndTime) {
  EXPECT_EQ(names({.order = FolderOrder::size}),
            (Names{"models", "bunny_1k.obj", "armadillo.ply", "Bunny.OBJ"}));
  EXPECT_EQ(names({.order = FolderOrder::modified}),
            (Names{"models", "Bunny.OBJ", "armadillo.ply", "bunny_1k.obj"}));
  EXPECT_EQ(names({.order = FolderOrder::modified, .is_descending = true}),
            (Names{"models", "bunny_1k.obj", "armadillo.ply", "Bunny.OBJ"}));
}

TEST_F(FolderTest, Filters) {
  EXPECT_EQ(names({.part = "BUN"}), (Names{"Bunny.OBJ", "bunny_1k.obj"}));
  EXPECT_EQ(names({.part = "nothing"}), Names{});
  EXPECT_EQ(names({.part = ".obj", .shows_hidden = true}),
            (Names{".hidden.obj", "Bunny.OBJ", "bunny_1k.obj"}));
  EXPECT_EQ(names({.part = ".h"}), (Names{".hidden.obj"})) << "a typed dot asks for hidden files";
  EXPECT_EQ(names({.part = "o", .shows_all_files = true}),
            (Names{"models", "armadillo.ply", "Bunny.OBJ", "bunny_1k.obj", "notes.txt"}));
}

TEST_F(FolderTest, UnreadableFolderHasAProblem) {
  EXPECT_NE(read_folder(folder_ / "none").problem, "");
  EXPECT_NE(read_folder(folder_ / "notes.txt").problem, "");
  EXPECT_EQ(read_folder(folder_ / "models").problem, "");
}

TEST_F(FolderTest, DanglingLinksAndPipesDoNoHarm) {
  fs::create_symlink("gone.obj", folder_ / "dangling.obj");
  ASSERT_EQ(mkfifo((folder_ / "pipe.pm").c_str(), 0600), 0);
  EXPECT_EQ(names({.part = "dangling"}), Names{});
  EXPECT_EQ(names({.part = "pipe"}), Names{"pipe.pm"});
}

TEST_F(FolderTest, CommonStartStopsAtACharacter) {
  const FolderEntry a{.name = "m\u00f6bius.obj"};
  const FolderEntry b{.name = "m\u00fcller.obj"};  // differs in the second byte of the character
  EXPECT_EQ(common_start({&a, &b}), "m");
  EXPECT_EQ(common_start({&a}), a.name);
}

TEST(Places, HomeSamplesBookmarksAndRoot) {
  const test::TempFolder home;
  fs::create_directories(home / "Downloads");
  fs::create_directories(home / ".config/gtk-3.0");
  fs::create_directories(home / "my models");
  home.write(".config/gtk-3.0/bookmarks", "file://" + home.path().string() +
                                              "/my%20models The models\n" +
                                              "file:///no/such/folder\nsftp://elsewhere/\n");
  const char* before = std::getenv("HOME");
  const std::string kept = before != nullptr ? before : "";
  setenv("HOME", home.path().c_str(), 1);
  const std::vector<Place> all = places();
  setenv("HOME", kept.c_str(), 1);
  const auto has = [&](const char* name, const fs::path& folder) {
    return std::ranges::any_of(
        all, [&](const Place& place) { return place.name == name && place.folder == folder; });
  };
  EXPECT_TRUE(has("Home", home.path()));
  EXPECT_TRUE(has("Downloads", home / "Downloads"));
  EXPECT_FALSE(has("Desktop", home / "Desktop")) << "it does not exist";
  EXPECT_TRUE(has("Samples", samples_folder()));
  EXPECT_TRUE(has("The models", home / "my models"));
  EXPECT_TRUE(has("File system", "/"));
  EXPECT_TRUE(std::ranges::none_of(all, [](const Place& place) {
    return place.folder.string().find("no/such") != std::string::npos;
  }));
}

}  // namespace
}  // namespace mesher::app
