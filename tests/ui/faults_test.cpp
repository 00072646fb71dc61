// Tests in a real window what goes wrong outside the program: a full disk, a lost GPU, a display
// that ends. Each time there is a message, nothing is lost, and the program goes on.
#include <gtest/gtest.h>

#include <chrono>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <thread>

#include "engine/io/read.h"
#include "tests/support/fault_layer.h"
#include "tests/support/file_faults.h"
#include "tests/support/small_disk.h"
#include "tests/support/temp_folder.h"
#include "tests/ui/window_fixture.h"
#include "tests/ui/xdnd_source.h"

namespace mesher::test {
namespace {

namespace fs = std::filesystem;

constexpr const char* kSamples = MESHER_SOURCE_DIR "/assets/";

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

TEST_F(FaultsTest, SignalDuringASaveLeavesNoPartialFileAndKeepsTheEdits) {
  FileFaults faults;
  faults.has_no_tmpfile = true;
  faults.slow_us = 20'000;
  for (const int milliseconds : {0, 40, 120, 400}) {
    SCOPED_TRACE(milliseconds);
    const TempFolder state;
    const TempFolder target;
    const auto v = std::make_unique<ViewerProcess>(
        *server_, std::vector<std::string>{"knot", "--size", "800x600"}, state.path(),
        "unix:path=/nonexistent", faults.environment());
    v->key("s");
    EXPECT_REACHES(*v, s["faces"] == 11'520);
    v->key("ctrl+s");
    EXPECT_REACHES(*v, s["save_dialog"] == true);
    v->settle();
    server_->xdotool({"type", "--delay", "60", (target / "saved.obj").string()});
    v->settle();
    v->key("Return");
    std::this_thread::sleep_for(std::chrono::milliseconds(milliseconds));
    v->send(SIGTERM);
    EXPECT_EQ(v->wait_for_end(), 128 + SIGTERM);
    for (const auto& entry : fs::directory_iterator(target.path())) {
      EXPECT_EQ(entry.path().filename(), "saved.obj");
      EXPECT_EQ(io::read_model(entry.path()).mesh.face_count(), 11'520U);
    }
    EXPECT_TRUE(fs::exists(target / "saved.obj") || !only_journal(state.path()).empty());
  }
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

TEST_F(FaultsTest, DisplayThatEndsLosesNoEdits) {
  const TempFolder home;
  {
    XServer server;
    ViewerProcess v(server, {"knot", "--size", "800x600"}, home.path());
    v.key("d");
    EXPECT_REACHES(v, s["undo_depth"] == 1);
    v.settle();
    server.end();
    EXPECT_EQ(v.wait_for_end(), 3);
    EXPECT_EQ(v.errors(),
              "mesher: the display was closed; mesher offers the unsaved edits when it starts "
              "again\n");
  }
  const auto v = open({"cube", "--size", "800x600"}, home.path());
  EXPECT_REACHES(*v, s["question"] == "lost");
  v->key("r");
  EXPECT_REACHES(*v, s["undo_depth"] == 1);
  quit(*v);
}

TEST_F(FaultsTest, WindowOpensWithoutMonitorHomeAndFonts) {
  const XServer server({"-extension", "RANDR"});
  ViewerProcess v(server, {"knot"}, {}, "unix:path=/nonexistent",
                  {"HOME", "XDG_STATE_HOME", "XDG_CONFIG_HOME", "XDG_PICTURES_DIR",
                   "FONTCONFIG_FILE=/nonexistent", "FONTCONFIG_PATH=/nonexistent"});
  v.key("d");
  EXPECT_REACHES(v, s["undo_depth"] == 1);
  EXPECT_REACHES(v, holds_words(s["notice"], "there is no home folder"));
  quit(v);
}

TEST_F(FaultsTest, HomeThatCannotBeWrittenIsSaid) {
  const auto v = open({"knot", "--size", "800x600"}, "/proc/no_home");
  EXPECT_REACHES(*v, holds_words(s["notice"], "settings are not remembered"));
  v->key("d");
  EXPECT_REACHES(*v, holds_words(s["error"],
                                 "edits cannot be restored after a crash: "
                                 "/proc/no_home/mesher: cannot make the folder: "));
  dismiss_error(*v);
  quit(*v);
}

TEST_F(FaultsTest, DeletedFolderAndReplacedFileLoseNothing) {
  const TempFolder folder;
  fs::create_directory(folder / "models");
  fs::copy(std::string(kSamples) + "knot.obj", folder / "models/knot.obj");
  const TempFolder home;
  {
    const auto v = open({(folder / "models/knot.obj").string(), "--size", "1000x700"}, home.path());
    v->key("d");
    EXPECT_REACHES(*v, s["undo_depth"] == 1);
    fs::remove_all(folder / "models");
    v->key("s");
    EXPECT_REACHES(*v, s["undo_depth"] == 2);
    v->key("ctrl+s");
    EXPECT_REACHES(*v, s["save_dialog"] == true);
    v->settle();
    v->key("Return");  // into the nearest folder that is left
    EXPECT_REACHES(*v, s["unsaved"] == false);
    EXPECT_EQ(io::read_model(folder / "knot-edited.obj").mesh.face_count(), 2592U * 4);
    fs::create_directory(folder / "models");
    fs::copy(std::string(kSamples) + "cube.obj", folder / "models/knot.obj");
    v->key("d");
    EXPECT_REACHES(*v, s["undo_depth"] == 3);
    v->settle();
    v->kill();
  }
  const auto v = open({"--size", "1000x700"}, home.path());
  EXPECT_REACHES(*v, s["question"] == "lost");
  v->key("r");  // of another file, they would be other edits
  v->settle();
  EXPECT_EQ(v->state()["question"], "lost");
  v->key("Delete");
  EXPECT_REACHES(*v, s["question"].is_null() && s["start"] == true);
  fs::remove_all(folder / "models");
  click(*v, "Welcome to mesher/recent knot.obj");
  EXPECT_REACHES(*v, holds_words(s["error"], "knot.obj"));
  dismiss_error(*v);
  click(*v, "Welcome to mesher/sample cube.obj");
  EXPECT_REACHES(*v, s["faces"] == 12);
  quit(*v);
}

/// Tests that quit while a file is written.
class QuitTest : public FaultsTest {
 protected:
  /// Begins to write a turntable of the shown model.
  static void start_turntable(const ViewerProcess& viewer, const std::string& scale) {
    viewer.key("shift+F12");
    EXPECT_REACHES(viewer, s["picture_dialog"] == true);
    viewer.settle();
    click(viewer, "Save a picture/turntable");
    server_->xdotool({"type", "--delay", "60", "turn.webp"});
    click(viewer, "Save a picture/scale");
    server_->xdotool({"key", "ctrl+a"});
    server_->xdotool({"type", "--delay", "60", scale});
    viewer.settle();
    viewer.key("Return");
    EXPECT_REACHES(viewer, s["picture_dialog"] == false);
  }
};

TEST_F(QuitTest, PictureIsFinishedFirst) {
  const auto v = open({"cube", "--size", "400x300"});
  start_turntable(*v, "1");
  v->press_close_button();
  EXPECT_EQ(v->wait_for_end(), 0) << v->state().dump(2);
  EXPECT_TRUE(fs::exists(v->folder() / "turn.webp"));
}

TEST_F(QuitTest, CanceledPictureKeepsTheWindow) {
  const auto v = open({"cube", "--size", "800x700"});
  start_turntable(*v, "8");  // takes minutes
  v->key("q");
  EXPECT_REACHES(*v, starts_with(s["notice"], "mesher ends when the file is written"));
  v->key("Escape");
  EXPECT_REACHES(*v, holds_words(s["notice"], "canceled"));
  EXPECT_FALSE(fs::exists(v->folder() / "turn.webp"));
  v->key("s");
  EXPECT_REACHES(*v, s["undo_depth"] == 1);
  quit(*v);
}

TEST_F(QuitTest, EditsThatComeMeanwhileAreAskedAbout) {
  const auto v = open({"cube", "--size", "400x300"});
  start_turntable(*v, "2");
  v->key("q");
  v->key("s");
  EXPECT_REACHES(*v, s["undo_depth"] == 1);
  EXPECT_REACHES(*v, s["question"] == "unsaved");
  EXPECT_TRUE(fs::exists(v->folder() / "turn.webp"));
  v->key("Delete");
  EXPECT_EQ(v->wait_for_end(), 0);
}

TEST_F(QuitTest, FailedSaveKeepsTheWindow) {
  const SmallDisk disk;
  disk.fill();
  const auto v = open({"knot", "--size", "800x600", "--keys", "s s s"});
  save_as(*v, v->folder() / "kept.obj");
  EXPECT_REACHES(*v, s["unsaved"] == false);
  save_as(*v, disk / "kept.pm");  // is built first, which takes seconds
  v->key("q");
  EXPECT_REACHES(*v, holds_words(s["error"], "No space left on device"));
  dismiss_error(*v);
  EXPECT_EQ(v->state()["faces"], 2880 * 64);
  quit(*v);
}

/// Tests whose programs run with a Vulkan layer that fails on a cue.
class GpuFaultsTest : public FaultsTest {
 protected:
  std::unique_ptr<ViewerProcess> open_with_faults(std::vector<std::string> arguments,
                                                  const fs::path& state_home = {}) const {
    return std::make_unique<ViewerProcess>(*server_, std::move(arguments), state_home,
                                           "unix:path=/nonexistent", faults_.environment());
  }
  /// The upper part of the window, without the line of notices.
  static std::vector<std::uint8_t> upper_part(const ViewerProcess& viewer) {
    viewer.settle();
    std::vector<std::uint8_t> bytes = viewer.screenshot();
    bytes.resize(bytes.size() / 4 * 3);
    return bytes;
  }
  void expect_over() const { EXPECT_TRUE(faults_.is_over()) << "the call did not fail"; }

  FaultLayer faults_;
};

TEST_F(GpuFaultsTest, WindowIsDrawnAgainAfterEveryLoss) {
  struct Loss {
    const char* call;
    VkResult result;
  };
  for (const Loss& loss : {Loss{"vkQueueSubmit2", VK_ERROR_DEVICE_LOST},
                           {"vkWaitSemaphores", VK_ERROR_DEVICE_LOST},
                           {"vkAcquireNextImageKHR", VK_ERROR_DEVICE_LOST},
                           {"vkQueuePresentKHR", VK_ERROR_DEVICE_LOST},
                           {"vkAcquireNextImageKHR", VK_ERROR_SURFACE_LOST_KHR},
                           {"vkQueuePresentKHR", VK_ERROR_SURFACE_LOST_KHR}}) {
    SCOPED_TRACE(std::string(loss.call) + " " + std::to_string(loss.result));
    const auto v = open_with_faults({"knot", "--size", "900x700", "--wireframe"});
    v->key("d");
    EXPECT_REACHES(*v, s["undo_depth"] == 1);
    const auto before = upper_part(*v);
    faults_.cue({{loss.call, loss.result}});
    v->key("w");
    EXPECT_REACHES(*v, starts_with(s["notice"], "restarted the graphics: ") &&
                           holds_words(s["notice"], loss.call));
    expect_over();
    v->key("w");
    EXPECT_REACHES(*v, s["wireframe"] == true && s["undo_depth"] == 1 && s["unsaved"] == true);
    EXPECT_EQ(upper_part(*v), before);
    v->key("d");
    EXPECT_REACHES(*v, s["undo_depth"] == 2);
    quit(*v);
  }
}

TEST_F(GpuFaultsTest, ChangedSurfaceIsFollowedWithoutAWord) {
  struct Change {
    const char* call;
    VkResult result;
  };
  for (const Change& change : {Change{"vkAcquireNextImageKHR", VK_ERROR_OUT_OF_DATE_KHR},
                               {"vkAcquireNextImageKHR", VK_SUBOPTIMAL_KHR},
                               {"vkQueuePresentKHR", VK_ERROR_OUT_OF_DATE_KHR},
                               {"vkQueuePresentKHR", VK_SUBOPTIMAL_KHR}}) {
    SCOPED_TRACE(std::string(change.call) + " " + std::to_string(change.result));
    const auto v = open_with_faults({"knot", "--size", "800x600"});
    v->key("w");
    EXPECT_REACHES(*v, s["wireframe"] == true);
    const auto lines = upper_part(*v);
    v->key("w");
    EXPECT_REACHES(*v, s["wireframe"] == false);
    v->settle();
    faults_.cue({{change.call, change.result, 3}});  // also in the last of the frames
    v->key("w");
    EXPECT_REACHES(*v, s["wireframe"] == true);
    EXPECT_EQ(upper_part(*v), lines);
    expect_over();
    EXPECT_EQ(v->state()["error"], "");
    quit(*v);
  }
}

TEST_F(GpuFaultsTest, StateOfPanelsOutlivesTheDevice) {
  const auto v = open_with_faults({"cube", "--size", "900x700"});
  v->key("ctrl+o");
  EXPECT_REACHES(*v, s["open_dialog"] == true);
  v->settle();
  server_->xdotool({"type", "--delay", "60", std::string(kSamples)});
  v->settle();
  faults_.cue({{"vkQueueSubmit2", VK_ERROR_DEVICE_LOST}});
  server_->xdotool({"type", "--delay", "60", "kno"});
  EXPECT_REACHES(*v, starts_with(s["notice"], "restarted the graphics: "));
  v->settle();
  server_->xdotool({"type", "--delay", "60", "t.obj"});
  v->settle();
  v->key("Return");
  EXPECT_REACHES(*v, s["faces"] == 2880 && s["open_dialog"] == false);
  quit(*v);
}

TEST_F(GpuFaultsTest, LossWhileAModelOpensDoesNotRefuseTheModel) {
  const auto v = open_with_faults({"cube", "--size", "800x600"});
  v->settle();
  faults_.cue({{"vkQueueSubmit2", VK_ERROR_DEVICE_LOST}});
  ASSERT_TRUE(
      drop_file(server_->display(), std::stoul(v->window()), std::string(kSamples) + "knot.obj"));
  EXPECT_REACHES(*v, s["faces"] == 2880);
  EXPECT_EQ(v->state()["error"], "");
  expect_over();
  quit(*v);
}

TEST_F(GpuFaultsTest, SecondLossAtOnceEndsTheProgramAndKeepsTheEdits) {
  // While the device is set up, and in the first frame after it.
  for (const char* second : {"vkQueueSubmit2", "vkQueuePresentKHR"}) {
    const TempFolder home;
    {
      const auto v = open_with_faults({"knot", "--size", "800x600"}, home.path());
      v->key("d");
      EXPECT_REACHES(*v, s["undo_depth"] == 1);
      v->settle();
      faults_.cue({{"vkQueueSubmit2", VK_ERROR_DEVICE_LOST}, {second, VK_ERROR_DEVICE_LOST}});
      v->key("w");
      EXPECT_EQ(v->wait_for_end(), 3);
      EXPECT_TRUE(v->errors().starts_with("mesher: the GPU stopped working (vkQueue"));
      EXPECT_TRUE(v->errors().ends_with(
          ": VK_ERROR_DEVICE_LOST) again, right after a restart; mesher offers the unsaved edits "
          "when it starts again\n"))
          << v->errors();
    }
    const auto v = open({"cube", "--size", "800x600"}, home.path());
    EXPECT_REACHES(*v, s["question"] == "lost");
    v->key("r");
    EXPECT_REACHES(*v, s["undo_depth"] == 1);
    quit(*v);
  }
}

TEST_F(GpuFaultsTest, DeviceThatCannotBeMadeAgainEndsTheProgram) {
  const auto v = open_with_faults({"knot", "--size", "800x600"});
  v->settle();
  faults_.cue({{"vkWaitSemaphores", VK_ERROR_DEVICE_LOST},
               {"vkCreateDevice", VK_ERROR_INITIALIZATION_FAILED}});
  v->key("w");
  EXPECT_EQ(v->wait_for_end(), 3);
  EXPECT_EQ(v->errors(),
            "mesher: the GPU stopped working (vkWaitSemaphores: VK_ERROR_DEVICE_LOST), and the "
            "graphics cannot be restarted: vkCreateDevice: VK_ERROR_INITIALIZATION_FAILED\n");
}

TEST_F(GpuFaultsTest, FullGpuRefusesAModelAndAnEdit) {
  const auto v = open_with_faults({"cube", "--size", "800x600"});
  v->key("s");
  EXPECT_REACHES(*v, s["undo_depth"] == 1 && s["faces"] == 48);
  const auto before = upper_part(*v);
  // The knot's indices take 34 kB, those of the subdivided cube some hundreds of bytes.
  faults_.cue({{"vkAllocateMemory", VK_ERROR_OUT_OF_DEVICE_MEMORY, 1, 30'000}});
  ASSERT_TRUE(
      drop_file(server_->display(), std::stoul(v->window()), std::string(kSamples) + "knot.obj"));
  EXPECT_REACHES(*v, starts_with(s["error"], "out of GPU memory"));
  expect_over();
  EXPECT_EQ(v->state()["tabs"], json::array({"cube.obj"}));
  EXPECT_EQ(v->state()["faces"], 48);
  EXPECT_EQ(v->state()["unsaved"], true);
  dismiss_error(*v);
  EXPECT_EQ(upper_part(*v), before);
  faults_.cue({{"vkAllocateMemory", VK_ERROR_OUT_OF_DEVICE_MEMORY, 1, 2000}});
  v->key("s");
  EXPECT_REACHES(*v, starts_with(s["error"], "out of GPU memory") && s["faces"] == 48);
  expect_over();
  EXPECT_EQ(v->state()["undo_depth"], 1);
  dismiss_error(*v);
  EXPECT_EQ(upper_part(*v), before);
  v->key("s");
  EXPECT_REACHES(*v, s["undo_depth"] == 2 && s["faces"] == 192);
  quit(*v);
}

TEST_F(GpuFaultsTest, FullGpuDrawsWithFewerSamples) {
  const auto v = open_with_faults({"cube", "--size", "400x300"});
  v->settle();
  // Of the larger images of four samples that a larger window needs.
  faults_.cue({{"vkAllocateMemory", VK_ERROR_OUT_OF_DEVICE_MEMORY, 1, 4'000'000}});
  server_->xdotool({"windowsize", v->window(), "1000", "800"});
  EXPECT_REACHES(*v, s["window"] == json::array({1000, 800}) && s["picture_finished"] == true);
  v->settle();
  expect_over();
  EXPECT_EQ(v->state()["error"], "");
  quit(*v);
}

}  // namespace
}  // namespace mesher::test
