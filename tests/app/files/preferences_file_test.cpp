#include "app/files/preferences_file.h"

#include <gtest/gtest.h>

#include "tests/support/small_disk.h"
#include "tests/support/temp_folder.h"

namespace mesher::app {
namespace {

namespace fs = std::filesystem;

class PreferencesFileTest : public testing::Test {
 protected:
  fs::path place() const { return folder_ / "config"; }
  fs::path file() const { return place() / "settings.json"; }
  void write(const std::string& text) {
    fs::create_directories(place());
    folder_.write("config/settings.json", text);
  }
  Preferences read(std::string* remark = nullptr) {
    PreferencesFile kept(place());
    const Preferences preferences = kept.read();
    const std::string text = kept.take_remark();
    if (remark != nullptr) *remark = text;
    return preferences;
  }

  test::TempFolder folder_;
};

TEST_F(PreferencesFileTest, EverythingComesBack) {
  Preferences preferences;
  remember_opened(preferences, "/models/a b\xFF.obj");
  remember_opened(preferences, "/other/c.ply");
  remember_saved(preferences, "/saved/x.glb");
  preferences.shows_hidden_files = true;
  PreferencesFile kept(place());
  EXPECT_EQ(kept.read(), Preferences());
  EXPECT_FALSE(fs::exists(place())) << "nothing is written before there is something to remember";
  kept.write(preferences);
  EXPECT_EQ(kept.take_remark(), "");
  EXPECT_EQ(read(), preferences);
}

TEST_F(PreferencesFileTest, GarbageIsSetAside) {
  const std::vector<std::string> damaged = {
      "",
      "{",
      "garbage",
      "[]",
      "{}",
      "null",
      R"({"mesher_settings": "one"})",
      R"({"mesher_settings": 1, "recent": 7})",
      R"({"mesher_settings": 1, "recent": [1, 2]})",
      R"({"mesher_settings": 1, "shows_hidden_files": "yes"})",
      R"({"mesher_settings": 1, "open_folder": {}})",
      std::string(100'000, '['),
      std::string("\0\0\0", 3),
  };
  for (const std::string& text : damaged) {
    SCOPED_TRACE(text.substr(0, 60));
    write(text);
    std::string remark;
    EXPECT_EQ(read(&remark), Preferences());
    EXPECT_NE(remark.find("settings.json was damaged"), std::string::npos) << remark;
    EXPECT_FALSE(fs::exists(file()));
    EXPECT_EQ(test::read_bytes(file().string() + ".damaged"), text) << "it is not lost";
  }
}

TEST_F(PreferencesFileTest, LaterVersionStaysAsItIs) {
  const std::string later = R"({"mesher_settings": 2, "recent": {"new": "layout"}})";
  write(later);
  PreferencesFile kept(place());
  Preferences preferences = kept.read();
  EXPECT_NE(kept.take_remark().find("later version"), std::string::npos);
  EXPECT_EQ(kept.take_remark(), "") << "said once";
  remember_opened(preferences, "/a.obj");
  kept.write(preferences);
  EXPECT_EQ(test::read_bytes(file()), later);
}

TEST_F(PreferencesFileTest, MissingKeysKeepTheirDefaults) {
  write(R"({"mesher_settings": 1, "save_extension": ".ply", "unknown": [1]})");
  std::string remark;
  const Preferences preferences = read(&remark);
  EXPECT_EQ(remark, "");
  EXPECT_EQ(preferences.save_extension, ".ply");
  EXPECT_TRUE(preferences.recent.empty());
}

TEST_F(PreferencesFileTest, TwoProgramsKeepEachOthersFiles) {
  PreferencesFile first(place());
  PreferencesFile second(place());
  Preferences a = first.read();
  Preferences b = second.read();
  remember_opened(a, "/a.obj");
  first.write(a);
  remember_opened(b, "/b.obj");
  second.write(b);
  EXPECT_EQ(read().recent, (std::vector<fs::path>{"/b.obj", "/a.obj"}));
}

TEST_F(PreferencesFileTest, RecentFilesAreBoundedAndOnceEach) {
  Preferences preferences;
  for (int i = 0; i < 50; ++i)
    remember_opened(preferences, "/f" + std::to_string(i % 20) + ".obj");
  EXPECT_EQ(preferences.recent.size(), Preferences::kMostRecent);
  EXPECT_EQ(preferences.recent.front(), "/f9.obj");
  remember_opened(preferences, "/f5.obj");
  EXPECT_EQ(preferences.recent.front(), "/f5.obj");
  EXPECT_EQ(std::ranges::count(preferences.recent, "/f5.obj"), 1);
  remember_opened(preferences, "/dev/null");
  EXPECT_EQ(preferences.recent.front(), "/f5.obj") << "a pipe or device cannot be opened again";
}

TEST_F(PreferencesFileTest, FullDiskIsSaidOnceAndTheNextChangeIsKept) {
  const test::SmallDisk disk;
  PreferencesFile kept(disk.path());
  Preferences preferences = kept.read();
  remember_opened(preferences, "/a.obj");
  kept.write(preferences);
  const std::string before = test::read_bytes(disk / "settings.json");
  disk.fill();
  remember_opened(preferences, "/b.obj");
  kept.write(preferences);
  const std::string remark = kept.take_remark();
  EXPECT_TRUE(remark.ends_with("No space left on device; settings are not remembered")) << remark;
  preferences.shows_hidden_files = true;
  kept.write(preferences);
  EXPECT_EQ(kept.take_remark(), "");
  EXPECT_EQ(test::read_bytes(disk / "settings.json"), before);
  EXPECT_EQ(disk.count_files(), 1U);
  disk.make_room();
  remember_opened(preferences, "/c.obj");
  kept.write(preferences);
  EXPECT_EQ(kept.take_remark(), "");
  EXPECT_EQ(PreferencesFile(disk.path()).read(), preferences);
}

TEST_F(PreferencesFileTest, FolderThatCannotBeWrittenIsSaidOnce) {
  folder_.write("config", "a file where the folder should be");
  PreferencesFile kept(place());
  Preferences preferences = kept.read();
  remember_opened(preferences, "/a.obj");
  kept.write(preferences);
  EXPECT_NE(kept.take_remark().find("not remembered"), std::string::npos);
  remember_opened(preferences, "/b.obj");
  kept.write(preferences);
  EXPECT_EQ(kept.take_remark(), "");
  PreferencesFile nowhere{fs::path()};
  EXPECT_EQ(nowhere.read(), Preferences());
  nowhere.write(preferences);
  EXPECT_EQ(nowhere.take_remark(), "");
}

}  // namespace
}  // namespace mesher::app
