// Tests in a real window the ways in which people open and save files.
#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "engine/io/pm_file.h"
#include "engine/io/png.h"
#include "engine/io/read.h"
#include "tests/support/mock_desktop.h"
#include "tests/support/temp_folder.h"
#include "tests/ui/window_fixture.h"
#include "tests/ui/xdnd_source.h"

namespace mesher::test {
namespace {

namespace fs = std::filesystem;

const fs::path kAssets = MESHER_SOURCE_DIR "/assets";

class FilesTest : public WindowTest {
 protected:
  static void type(const ViewerProcess& viewer, const std::string& text) {
    server_->xdotool({"type", "--delay", "60", text});
    viewer.settle();
  }
  static void open_dialog(const ViewerProcess& viewer) {
    viewer.key("ctrl+o");
    EXPECT_REACHES(viewer, s["open_dialog"] == true);
    viewer.settle();
  }
  /// Saves the model under a new name.
  static void save_as(const ViewerProcess& viewer, const fs::path& file) {
    viewer.key("ctrl+s");
    EXPECT_REACHES(viewer, s["save_dialog"] == true);
    viewer.settle();
    type(viewer, file.string());
    viewer.key("Return");
    EXPECT_REACHES(viewer, s["save_dialog"] == false);
    EXPECT_REACHES(viewer, s["notice"].get<std::string>().starts_with("saved " + file.string()));
  }
};

TEST_F(FilesTest, DialogOpensAClickedFileAndACompletedName) {
  const TempFolder folder;
  fs::create_directory(folder / "models");
  fs::copy(kAssets / "knot.obj", folder / "models/knot.obj");
  fs::copy(kAssets / "cube.obj", folder / "models/cube.obj");
  const auto v = open({"hypersheet", "--size", "1000x700"});
  open_dialog(*v);
  type(*v, folder.path().string() + "/mod");
  v->key("Tab");
  v->settle();
  click(*v, "Open a model/file knot.obj");
  EXPECT_EQ(v->state()["open_dialog"], true) << "one click only chooses it";
  click(*v, "Open a model/open");
  EXPECT_REACHES(*v, s["open_dialog"] == false && s["faces"] == 2880);
  EXPECT_EQ(v->state()["wireframe"], false) << "the letters were text, not shortcuts";
  open_dialog(*v);
  type(*v, "cu");  // the dialog is in the folder of the last file
  v->key("Return");
  EXPECT_REACHES(*v, s["open_dialog"] == false && s["faces"] == 12);
  open_dialog(*v);
  v->key("Down");
  v->key("Down");
  v->key("Return");
  EXPECT_REACHES(*v, s["open_dialog"] == false && s["faces"] == 2880);
  EXPECT_EQ(v->state()["tabs"].size(), 4U);
  quit(*v);
}

TEST_F(FilesTest, NamesInAnyScriptAreListedAndOpened) {
  const TempFolder folder;
  // The font is built again for the title, the list and the tabs, while frames are in flight.
  for (const char* name : {"\u5154\u5b50.obj", "\u0443\u0437\u0435\u043b.obj", "\u2312.obj",
                           "bad\xff\x80.obj", "\xF0\x9F\x90\xB0.obj"})
    fs::copy(kAssets / "knot.obj", folder / name);
  const auto v = open({(folder / "\u2312.obj").string(), "--size", "1000x700"});
  EXPECT_NE(v->title().find("\u2312.obj"), std::string::npos);
  open_dialog(*v);
  v->settle();
  for (const char* name : {"\u5154\u5b50.obj", "\u0443\u0437\u0435\u043b.obj"})
    (void)place_of(*v, std::string("Open a model/file ") + name);
  click(*v, "Open a model/file \u0443\u0437\u0435\u043b.obj");
  click(*v, "Open a model/open");
  EXPECT_REACHES(*v, s["tabs"].size() == 2 &&
                         s["file"].get<std::string>().ends_with("\u0443\u0437\u0435\u043b.obj"));
  open_dialog(*v);
  // Invalid bytes are replaced in the log of the state.
  click(*v, "Open a model/file bad\ufffd\ufffd.obj");
  v->key("Escape");
  EXPECT_REACHES(*v, s["open_dialog"] == false);
  v->settle();
  quit(*v);
}

TEST_F(FilesTest, MistakesStayInTheDialog) {
  const TempFolder folder;
  const fs::path bad = folder.write("bad.obj", "v 0 0 0\nf 1 2 3\n");
  const auto v = open({"cube", "--size", "1000x700"});
  open_dialog(*v);
  type(*v, "/no/such/file.obj");
  v->key("Return");
  EXPECT_REACHES(*v, s["open_problem"].get<std::string>().find("there is no file") == 0);
  EXPECT_EQ(v->state()["open_dialog"], true);
  v->settle();
  type(*v, bad.string());
  v->key("Return");
  EXPECT_REACHES(*v, s["open_problem"].get<std::string>().find("bad.obj:2") != std::string::npos);
  EXPECT_EQ(v->state()["open_dialog"], true);
  EXPECT_EQ(v->state()["error"], "");
  type(*v, "sgw");  // text, not commands
  EXPECT_EQ(v->state()["faces"], 12);
  EXPECT_EQ(v->state()["shading"], "flat");
  v->key("Escape");
  EXPECT_REACHES(*v, s["open_dialog"] == false);
  quit(*v);
}

TEST_F(FilesTest, DroppedFilesOpenAsTabs) {
  const TempFolder folder;
  const fs::path bad = folder.write("bad.obj", "no mesh");
  const auto v = open({"cube", "--size", "1000x700"});
  ASSERT_TRUE(drop_files(server_->display(), std::stoul(v->window()),
                         {kAssets / "knot.obj", bad, kAssets / "hypersheet.obj"}));
  EXPECT_REACHES(*v, s["tabs"] == json::array({"cube.obj", "knot.obj", "hypersheet.obj"}));
  EXPECT_REACHES(*v, s["error"].get<std::string>().find("bad.obj") != std::string::npos);
  v->key("Escape");
  EXPECT_REACHES(*v, s["error"] == "");
  click(*v, "tabs/tab knot.obj");
  EXPECT_REACHES(*v, s["tab"] == 1 && s["faces"] == 2880);
  v->key("d");
  EXPECT_REACHES(*v, s["faces"] == 2592);
  v->key("ctrl+Prior");
  EXPECT_REACHES(*v, s["tab"] == 0 && s["faces"] == 12);
  v->key("ctrl+Next");
  EXPECT_REACHES(*v, s["tab"] == 1 && s["faces"] == 2592 && s["undo_depth"] == 1);
  v->settle();
  EXPECT_EQ(v->title().substr(0, 9), "*knot.obj");
  quit(*v);
}

TEST_F(FilesTest, SeveralModelsOfTheCommandLineOpenAsTabs) {
  const TempFolder folder;
  fs::copy(kAssets / "knot.obj", folder / "cube.obj");
  const auto v =
      open({(kAssets / "cube.obj").string(), (folder / "cube.obj").string(), "--size", "1000x700"});
  EXPECT_REACHES(*v, s["tabs"] == json::array({"cube.obj", "cube.obj"}));
  click(*v, "tabs/tab cube.obj");
  EXPECT_REACHES(*v, s["tab"] == 0 && s["faces"] == 12);
  click(*v, "tabs/tab cube.obj (2)");
  EXPECT_REACHES(*v, s["tab"] == 1 && s["faces"] == 2880);
  quit(*v);
}

TEST_F(FilesTest, AHundredDroppedFilesLoseNothing) {
  const TempFolder folder;
  std::vector<std::string> files;
  for (int i = 0; i < 100; ++i) {
    const fs::path file = folder / (std::to_string(i) + (i % 3 == 0 ? ".txt" : ".obj"));
    fs::copy(kAssets / "cube.obj", file);
    files.push_back(file.string());
  }
  const auto v = open({"knot", "--size", "800x600"});
  v->key("d");
  EXPECT_REACHES(*v, s["undo_depth"] == 1);
  ASSERT_TRUE(drop_files(server_->display(), std::stoul(v->window()), files));
  EXPECT_REACHES(*v, s["tabs"].size() == 67);
  EXPECT_REACHES(*v, s["error"].get<std::string>().find("and 29 more files") != std::string::npos);
  v->key("q");
  EXPECT_REACHES(*v, s["question"] == "unsaved" && s["faces"] == 2592);
  v->key("Delete");
  EXPECT_EQ(v->wait_for_end(), 0);
}

TEST_F(FilesTest, StartScreenOpensSamplesAndRecentFiles) {
  const TempFolder home;
  {
    const auto v = open({"--size", "1000x700"}, home.path());
    EXPECT_REACHES(*v, s["start"] == true);
    click(*v, "Welcome to mesher/sample cube.obj");
    EXPECT_REACHES(*v, s["start"] == false && s["faces"] == 12);
    EXPECT_REACHES(*v, s["tabs"] == json::array({"cube.obj"}));
    quit(*v);
  }
  const auto v = open({"--size", "1000x700"}, home.path());
  EXPECT_REACHES(*v, s["start"] == true);
  click(*v, "Welcome to mesher/recent cube.obj");
  EXPECT_REACHES(*v, s["start"] == false && s["faces"] == 12);
  quit(*v);
}

TEST_F(FilesTest, WindowIsThereBeforeTheModel) {
  const TempFolder folder;
  const std::string pipe = folder / "slow.obj";
  ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
  const auto v = open({pipe, "--size", "800x600"});
  EXPECT_REACHES(*v, s["tabs"] == json::array({""}) && s["faces"] == 0);
  v->settle();
  v->key("s");
  v->key("ctrl+z");
  std::ofstream(pipe) << read_bytes(kAssets / "cube.obj");
  EXPECT_REACHES(*v, s["tabs"] == json::array({"slow.obj"}) && s["faces"] == 12);
  quit(*v);
}

TEST_F(FilesTest, CanceledFirstFileLeavesTheStartScreen) {
  const TempFolder folder;
  const std::string pipe = folder / "never.obj";
  ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
  const int out = ::open(pipe.c_str(), O_RDWR | O_CLOEXEC);
  const auto v = open({pipe, "--size", "1000x700"});
  EXPECT_REACHES(*v, s["faces"] == 0);
  v->settle();
  ASSERT_EQ(::write(out, "v 0 0 0\nf 1 2 3\n", 16), 16);
  ::close(out);
  EXPECT_REACHES(*v, s["start"] == true && s["error"] != "");
  click(*v, "Welcome to mesher/sample cube.obj");
  EXPECT_REACHES(*v, s["faces"] == 12 && s["start"] == false);
  quit(*v);
}

TEST_F(FilesTest, HeavyModelIsCoarseWhileItMoves) {
  const auto v = open({"knot", "--size", "800x600", "--keys", "s s s s s"});
  EXPECT_REACHES(*v, s["faces"] == 2880 * 1024 && s["picture_finished"] == true);
  v->settle();
  v->move(400, 300);
  v->press(1);
  v->move(430, 310);
  v->move(460, 320);
  EXPECT_REACHES(*v, s["picture_finished"] == false);
  v->release(1);
  EXPECT_REACHES(*v, s["picture_finished"] == true);
  v->settle();
  const auto refined = v->screenshot();
  v->key("ctrl+z");
  EXPECT_REACHES(*v, s["faces"] == 2880 * 256 && s["picture_finished"] == true);
  v->key("ctrl+y");
  EXPECT_REACHES(*v, s["faces"] == 2880 * 1024 && s["picture_finished"] == true);
  v->settle();
  EXPECT_EQ(v->screenshot().size(), refined.size());
  quit(*v);
}

TEST_F(FilesTest, DamagedSettingsAreSaidAndReplaced) {
  const TempFolder home;
  fs::create_directories(home / "config/mesher");
  home.write("config/mesher/settings.json", "{garbage");
  const auto v = open({"cube", "--size", "800x600"}, home.path());
  EXPECT_REACHES(*v, s["notice"].get<std::string>().find("was damaged") != std::string::npos);
  quit(*v);
  EXPECT_TRUE(fs::exists(home / "config/mesher/settings.json.damaged"));
  EXPECT_TRUE(json::accept(read_bytes(home / "config/mesher/settings.json")));
}

TEST_F(FilesTest, SimplifiedUndoneAndSavedInThreeFormats) {
  const TempFolder folder;
  const auto v = open({"knot", "--size", "1200x800"});
  v->key("d");
  EXPECT_REACHES(*v, s["undo_depth"] == 1);
  v->key("d");
  EXPECT_REACHES(*v, s["undo_depth"] == 2);
  click(*v, "facts/step 1");
  EXPECT_REACHES(*v, s["undo_depth"] == 1 && s["redo_depth"] == 1);
  save_as(*v, folder / "a.ply");
  EXPECT_REACHES(*v, s["unsaved"] == false);
  save_as(*v, folder / "a.glb");
  save_as(*v, folder / "a.pm");
  EXPECT_EQ(io::read_model(folder / "a.ply").mesh.face_count(), 2592U);
  EXPECT_EQ(io::read_model(folder / "a.glb").mesh.face_count(), 2592U);
  EXPECT_EQ(io::read_pm_file(folder / "a.pm").summary.faces, 2592U);
  quit(*v);
}

TEST_F(FilesTest, FailedSaveLosesNothing) {
  const auto v = open({"knot", "--size", "1000x700"});
  v->key("d");
  EXPECT_REACHES(*v, s["unsaved"] == true);
  v->key("ctrl+s");
  EXPECT_REACHES(*v, s["save_dialog"] == true);
  v->settle();
  type(*v, "/proc/no_file_can_be_made_here.obj");
  v->key("Return");
  EXPECT_REACHES(*v, s["error"].get<std::string>().find("/proc/no_file") != std::string::npos);
  EXPECT_EQ(v->state()["unsaved"], true);
  EXPECT_EQ(v->state()["undo_depth"], 1);
  v->key("Escape");
  EXPECT_REACHES(*v, s["error"] == "");
  save_as(*v, v->folder() / "kept.obj");
  EXPECT_REACHES(*v, s["unsaved"] == false);
  quit(*v);
}

TEST_F(FilesTest, WindowClosedDuringAJobAsksAndEnds) {
  const auto v = open({"knot", "--size", "800x600"});
  for (int i = 0; i < 7; ++i)
    v->key("s");
  v->press_close_button();
  EXPECT_REACHES(*v, s["question"] == "unsaved");
  v->key("Delete");
  EXPECT_EQ(v->wait_for_end(), 0);
}

TEST_F(FilesTest, EscapeClosesADialogBeforeItCancelsAJob) {
  const auto v = open({"knot", "--size", "800x600"});
  for (int i = 0; i < 4; ++i)
    v->key("s");
  v->key("ctrl+o");
  v->key("Escape");
  EXPECT_REACHES(*v, s["open_dialog"] == false && s["subdivision_level"] == 4);
  quit(*v);
}

TEST_F(FilesTest, FormatIsChosenFromAList) {
  const TempFolder folder;
  fs::copy(kAssets / "creased_cube.obj", folder / "box.obj");
  const auto v = open({(folder / "box.obj").string(), "--size", "1000x700"});
  v->key("ctrl+s");
  EXPECT_REACHES(*v, s["save_dialog"] == true);
  v->settle();
  click(*v, "Save the model/format");
  v->settle();
  const json widgets = v->state()["widgets"];
  const auto ply = std::ranges::find_if(
      widgets.items(), [](const auto& widget) { return widget.key().ends_with("/.ply"); });
  ASSERT_NE(ply, widgets.items().end()) << widgets.dump();
  click(*v, ply.key());
  click(*v, "Save the model/save");
  EXPECT_REACHES(*v, s["save_dialog"] == false);
  EXPECT_REACHES(*v, s["notice"].get<std::string>().find("does not hold") != std::string::npos);
  EXPECT_EQ(io::read_model(folder / "box-edited.ply").mesh.face_count(), 12U);
  quit(*v);
}

TEST_F(FilesTest, PictureDialogWritesPictureAndTurntable) {
  const auto v = open({"cube", "--size", "800x700"});
  v->key("shift+F12");
  EXPECT_REACHES(*v, s["picture_dialog"] == true);
  v->settle();
  type(*v, "twice.png");
  click(*v, "Save a picture/scale");
  server_->xdotool({"key", "ctrl+a"});
  type(*v, "2");
  click(*v, "Save a picture/transparent");
  click(*v, "Save a picture/save");
  EXPECT_REACHES(*v, s["notice"].get<std::string>().ends_with("twice.png"));
  const Image image = io::read_png(v->folder() / "twice.png");
  const json size = v->state()["model_rectangle"];
  EXPECT_EQ(image.width, 2 * size[2].get<unsigned>());
  EXPECT_EQ(image.height, 2 * size[3].get<unsigned>());
  EXPECT_EQ(image.rgba[3], 0) << "the corner is transparent";
  v->key("shift+F12");
  EXPECT_REACHES(*v, s["picture_dialog"] == true);
  v->settle();
  click(*v, "Save a picture/turntable");
  type(*v, "turn.webp");
  click(*v, "Save a picture/scale");
  server_->xdotool({"key", "ctrl+a"});
  type(*v, "8");  // takes minutes: it is canceled long before it is done
  v->key("Return");
  EXPECT_REACHES(*v, s["picture_dialog"] == false);
  v->key("Escape");  // cancels
  EXPECT_REACHES(*v, s["notice"].get<std::string>().find("canceled") != std::string::npos);
  EXPECT_FALSE(fs::exists(v->folder() / "turn.webp"));
  quit(*v);
}

/// The program on a desktop that has dialogs of files.
class DesktopFilesTest : public FilesTest {
 protected:
  void SetUp() override {
    ASSERT_FALSE(python_with_dbusmock().empty()) << "no mock desktop (scripts/bootstrap test)";
  }
  static std::unique_ptr<ViewerProcess> open_on(const MockBus& bus) {
    return std::make_unique<ViewerProcess>(
        *server_, std::vector<std::string>{"hypersheet", "--size", "800x600"},
        std::filesystem::path(), bus.address());
  }
  static std::string uri(const fs::path& file) { return "file://" + file.string(); }
};

TEST_F(DesktopFilesTest, DesktopsDialogOpensSeveralFiles) {
  const MockBus bus;
  const MockPortal portal(
      bus, {{"version", 3},
            {"results", {{"uris", {uri(kAssets / "cube.obj"), uri(kAssets / "knot.obj")}}}}});
  const auto v = open_on(bus);
  v->key("ctrl+o");
  EXPECT_REACHES(*v, s["tabs"] == json::array({"hypersheet.obj", "cube.obj", "knot.obj"}));
  EXPECT_EQ(v->state()["open_dialog"], false);
  quit(*v);
}

TEST_F(DesktopFilesTest, DesktopsDialogSaves) {
  const TempFolder folder;
  const MockBus bus;
  const MockPortal portal(bus, {{"version", 3}, {"results", {{"uris", {uri(folder / "saved")}}}}});
  const auto v = open_on(bus);
  v->key("d");
  EXPECT_REACHES(*v, s["unsaved"] == true);
  v->key("ctrl+s");
  EXPECT_REACHES(*v, s["unsaved"] == false);
  EXPECT_EQ(portal.wait_for("SaveFile")["options"]["current_name"], "hypersheet-edited.obj");
  EXPECT_TRUE(fs::exists(folder / "saved.obj")) << "the extension was not typed";
  quit(*v);
}

TEST_F(DesktopFilesTest, OwnDialogReplacesOneThatFails) {
  const MockBus bus;
  const MockPortal portal(bus, {{"version", 3}, {"response", 2}});
  const auto v = open_on(bus);
  v->key("ctrl+o");
  EXPECT_FALSE(portal.wait_for("OpenFile").is_null());
  EXPECT_REACHES(*v, s["open_dialog"] == true);
  v->settle();
  type(*v, "cube.obj");
  v->key("Return");
  EXPECT_REACHES(*v, s["faces"] == 12);
  quit(*v);
}

}  // namespace
}  // namespace mesher::test
