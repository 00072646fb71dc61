// Tests in a real window what goes wrong outside the program: a full disk, a lost GPU, a display
// that ends. Each time there is a message, nothing is lost, and the program goes on.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "engine/io/read.h"
#include "tests/support/small_disk.h"
#include "tests/support/temp_folder.h"
#include "tests/ui/window_fixture.h"

namespace mesher::test {
namespace {

namespace fs = std::filesystem;

bool starts_with(const json& text, const std::string& words) {
  return text.get<std::string>().starts_with(words);
}
bool holds_words(const json& text, const std::string& words) {
  return text.get<std::string>().find(words) != std::string::npos;
}

class FaultsTest : public WindowTest {
 protected:
  static void save_as(const ViewerProcess& viewer, const fs::path& file) {
    viewer.key("ctrl+s");
    EXPECT_REACHES(viewer, s["save_dialog"] == true);
    viewer.settle();
    server_->xdotool({"type", "--delay", "60", file.string()});
    viewer.settle();
    viewer.key("Return");
    EXPECT_REACHES(viewer, s["save_dialog"] == false);
  }
  static void dismiss_error(const ViewerProcess& viewer) {
    viewer.key("Escape");
    EXPECT_REACHES(viewer, s["error"] == "");
  }
  static fs::path only_journal(const fs::path& state) {
    for (const auto& entry : fs::directory_iterator(state / "mesher"))
      if (entry.path().extension() == ".journal") return entry.path();
    return {};
  }
};

TEST_F(FaultsTest, FullDiskLosesNoModelAndNoPicture) {
  const SmallDisk disk;
  disk.fill();
  const auto v = open({"knot", "--size", "1000x700"});
  v->key("d");
  EXPECT_REACHES(*v, s["unsaved"] == true);
  for (const char* name : {"kept.obj", "kept.ply", "kept.pm"}) {
    SCOPED_TRACE(name);
    save_as(*v, disk / name);
    EXPECT_REACHES(*v, holds_words(s["error"], "No space left on device"));
    EXPECT_EQ(v->state()["unsaved"], true);
    EXPECT_EQ(disk.count_files(), 0U);
    dismiss_error(*v);
  }
  v->key("shift+F12");
  EXPECT_REACHES(*v, s["picture_dialog"] == true);
  v->settle();
  server_->xdotool({"type", "--delay", "60", (disk / "p.png").string()});
  v->settle();
  v->key("Return");
  EXPECT_REACHES(*v, holds_words(s["error"], "No space left on device"));
  EXPECT_EQ(disk.count_files(), 0U);
  dismiss_error(*v);
  disk.make_room();
  save_as(*v, disk / "kept.stl");
  EXPECT_REACHES(*v, holds_words(s["error"], "No space left on device")) << "it is too large";
  dismiss_error(*v);
  save_as(*v, v->folder() / "kept.obj");
  EXPECT_REACHES(*v, s["unsaved"] == false);
  EXPECT_EQ(io::read_model(v->folder() / "kept.obj").mesh.face_count(), 2592U);
  quit(*v);
}

TEST_F(FaultsTest, JournalOnAFullDiskIsSaidOnceAndWrittenOnceThereIsRoom) {
  const SmallDisk disk;
  {
    const auto v = open({"knot", "--size", "800x600"}, disk.path());
    disk.fill();
    v->key("d");
    EXPECT_REACHES(*v, starts_with(s["error"], "edits cannot be restored after a crash") &&
                           holds_words(s["error"], "No space left on device"));
    dismiss_error(*v);
    v->key("d");
    EXPECT_REACHES(*v, s["undo_depth"] == 2);
    v->settle();
    EXPECT_EQ(v->state()["error"], "") << "not once per edit";
    EXPECT_TRUE(only_journal(disk.path()).empty());
    disk.make_room();
    // Without another edit.
    EXPECT_REACHES(*v, s["notice"] == "edits can be restored after a crash again");
    EXPECT_FALSE(only_journal(disk.path()).empty());
    v->kill();
  }
  const auto v = open({"cube", "--size", "800x600"}, disk.path());
  EXPECT_REACHES(*v, s["question"] == "lost");
  v->key("r");
  EXPECT_REACHES(*v, s["undo_depth"] == 2);
  quit(*v);
}

}  // namespace
}  // namespace mesher::test
