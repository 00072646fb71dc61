#include "app/files/desktop_dialog.h"

#include <gtest/gtest.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "tests/support/mock_desktop.h"
#include "tests/support/temp_folder.h"

namespace mesher::app {
namespace {

using nlohmann::json;
using test::MockBus;
using test::MockPortal;
using test::Variable;
using Paths = std::vector<std::filesystem::path>;

std::atomic<int> desktop_wakes = 0;

void count_desktop_wake() {
  ++desktop_wakes;
}

double seconds_since(std::chrono::steady_clock::time_point begin) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

/// Waits up to a minute until the portal is found, as its first answer may take long on a busy
/// machine.
bool becomes_available(DesktopDialog& desktop) {
  const auto begin = std::chrono::steady_clock::now();
  while (!desktop.is_available() && seconds_since(begin) < 60.0) {
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  return desktop.is_available();
}

std::optional<DialogAnswer> wait_for_answer(DesktopDialog& desktop) {
  const auto begin = std::chrono::steady_clock::now();
  while (seconds_since(begin) < 60.0) {
    if (auto answer = desktop.take()) return answer;
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  return std::nullopt;
}

/// Asks a portal of these parameters for files to open.
DialogAnswer answer_of(const json& parameters, bool allows_several = false) {
  const MockBus bus;
  const MockPortal portal(bus, parameters);
  DesktopDialog desktop(nullptr);
  desktop.open({.title = "Open a model"}, allows_several);
  return wait_for_answer(desktop).value_or(DialogAnswer{.problem = "no answer within a minute"});
}

DialogAnswer answer_of_uris(const std::vector<std::string>& uris) {
  return answer_of({{"version", 4}, {"results", {{"uris", uris}}}}, true);
}

/// Needs a bus and a portal.
class DesktopDialogOnBus : public testing::Test {
 protected:
  void SetUp() override {
    ASSERT_FALSE(test::python_with_dbusmock().empty())
        << "no mock desktop (scripts/bootstrap test)";
  }
};

TEST(DesktopDialogWithoutBus, IsNotAvailable) {
  const Variable address("DBUS_SESSION_BUS_ADDRESS", std::nullopt);
  const Variable runtime("XDG_RUNTIME_DIR", std::nullopt);
  DesktopDialog desktop(nullptr);
  EXPECT_FALSE(desktop.is_available());
}

TEST(DesktopDialogWithoutBus, IgnoresFileInPlaceOfSocket) {
  const test::TempFolder folder;
  folder.write("bus", "");
  const Variable address("DBUS_SESSION_BUS_ADDRESS", std::nullopt);
  const Variable runtime("XDG_RUNTIME_DIR", folder.path().string());
  DesktopDialog desktop(nullptr);
  EXPECT_FALSE(desktop.is_available());
}

TEST(DesktopDialogWithoutBus, StartsNoBus) {
  const test::TempFolder folder;
  const auto started = folder / "started";
  const auto launcher = folder.write("dbus-launch", "#!/bin/sh\n: >" + started.string() + "\n");
  ASSERT_EQ(chmod(launcher.c_str(), 0700), 0);
  const Variable path("PATH", folder.path().string());
  const Variable display("DISPLAY", ":77");
  const Variable runtime("XDG_RUNTIME_DIR", std::nullopt);
  for (const std::optional<std::string>& address :
       {std::optional<std::string>{}, {"autolaunch:"}, {"autolaunch:scope=x;autolaunch:"}}) {
    const Variable variable("DBUS_SESSION_BUS_ADDRESS", address);
    DesktopDialog desktop(nullptr);
    EXPECT_FALSE(desktop.is_available());
    desktop.open({.title = "Open"}, false);
    const auto answer = wait_for_answer(desktop);
    ASSERT_TRUE(answer);
    EXPECT_EQ(answer->outcome, DialogOutcome::failed);
  }
  EXPECT_FALSE(std::filesystem::exists(started));
}

TEST(DesktopDialogWithoutBus, BusThatAcceptsAndHangsIsNotAvailable) {
  const test::TempFolder folder;
  const int listener = socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0);
  sockaddr_un place{};
  place.sun_family = AF_UNIX;
  const std::string path = folder / "bus";
  path.copy(place.sun_path, sizeof place.sun_path - 1);
  ASSERT_EQ(bind(listener, reinterpret_cast<const sockaddr*>(&place), sizeof place), 0);
  ASSERT_EQ(listen(listener, 8), 0);
  const Variable address("DBUS_SESSION_BUS_ADDRESS", "unix:path=" + path);
  const auto begin = std::chrono::steady_clock::now();
  {
    DesktopDialog desktop(nullptr);
    EXPECT_FALSE(desktop.is_available());
    EXPECT_FALSE(desktop.is_available());
    desktop.open({.title = "Open"}, false);
  }
  EXPECT_LT(seconds_since(begin), 2.5);  // the attempt itself takes 3 s
  DesktopDialog desktop(nullptr);
  desktop.open({.title = "Open"}, false);
  const auto answer = wait_for_answer(desktop);
  ASSERT_TRUE(answer);
  EXPECT_EQ(answer->outcome, DialogOutcome::failed);
  EXPECT_NE(answer->problem.find("bus"), std::string::npos) << answer->problem;
  close(listener);
}

TEST_F(DesktopDialogOnBus, BusThatNeverGreetsIsNotAvailable) {
  const MockBus bus(false);
  const auto begin = std::chrono::steady_clock::now();
  {
    DesktopDialog desktop(nullptr);
    EXPECT_FALSE(desktop.is_available());
  }
  EXPECT_LT(seconds_since(begin), 2.5);
}

TEST_F(DesktopDialogOnBus, IsNotAvailableWithoutPortal) {
  const MockBus bus;
  DesktopDialog desktop(nullptr);
  EXPECT_FALSE(desktop.is_available());
}

TEST_F(DesktopDialogOnBus, IsAvailableWithPortal) {
  const MockBus bus;
  const MockPortal portal(bus, {{"version", 3}});
  DesktopDialog desktop(nullptr);
  EXPECT_TRUE(becomes_available(desktop));
  EXPECT_FALSE(desktop.is_open());
  EXPECT_FALSE(desktop.take());
}

TEST_F(DesktopDialogOnBus, FindsBusInRuntimeFolder) {
  const MockBus bus;
  const MockPortal portal(bus, {{"version", 3}});
  const Variable address("DBUS_SESSION_BUS_ADDRESS", std::nullopt);
  const Variable runtime("XDG_RUNTIME_DIR", bus.folder().path().string());
  DesktopDialog desktop(nullptr);
  EXPECT_TRUE(becomes_available(desktop));
}

TEST_F(DesktopDialogOnBus, SkipsAutolaunchInListOfAddresses) {
  const MockBus bus;
  const MockPortal portal(bus, {{"version", 3}});
  const Variable address("DBUS_SESSION_BUS_ADDRESS", "autolaunch:;" + bus.address());
  DesktopDialog desktop(nullptr);
  EXPECT_TRUE(becomes_available(desktop));
}

TEST_F(DesktopDialogOnBus, PortalWithoutFileChooserIsNotAvailable) {
  for (const json& parameters : {json::object(), json{{"version", "three"}}}) {
    const MockBus bus;
    const MockPortal portal(bus, parameters);
    DesktopDialog desktop(nullptr);
    EXPECT_FALSE(desktop.is_available());
  }
}

TEST_F(DesktopDialogOnBus, FrozenPortalIsAvailableOnceItAnswers) {
  const MockBus bus;
  MockPortal portal(bus, {{"version", 4}});
  portal.freeze(true);
  DesktopDialog desktop(nullptr);
  const auto begin = std::chrono::steady_clock::now();
  EXPECT_FALSE(desktop.is_available());
  EXPECT_LT(seconds_since(begin), 5.0);
  portal.freeze(false);
  EXPECT_TRUE(becomes_available(desktop));
}

TEST_F(DesktopDialogOnBus, OpenReturnsChosenFile) {
  const MockBus bus;
  const MockPortal portal(bus, {{"version", 4}, {"results", {{"uris", {"file:///models/a.obj"}}}}});
  DesktopDialog desktop(&count_desktop_wake);
  desktop_wakes = 0;
  desktop.open({.title = "Open a model"}, false);
  EXPECT_TRUE(desktop.is_open());
  const auto answer = wait_for_answer(desktop);
  ASSERT_TRUE(answer);
  EXPECT_EQ(answer->outcome, DialogOutcome::chosen) << answer->problem;
  EXPECT_EQ(answer->files, Paths{"/models/a.obj"});
  EXPECT_FALSE(desktop.is_open());
  EXPECT_FALSE(desktop.take());
  EXPECT_EQ(desktop_wakes, 1);
}

TEST_F(DesktopDialogOnBus, DecodesNames) {
  const DialogAnswer answer =
      answer_of_uris({"file:///with%20blank/a%25b%23.obj", "file:///h%C3%BCte/%E6%A8%A1.ply",
                      "file:///h\u00fc.stl", "file://localhost/x.off", "file:///not%FFutf8.obj"});
  EXPECT_EQ(answer.outcome, DialogOutcome::chosen) << answer.problem;
  EXPECT_EQ(answer.files, (Paths{"/with blank/a%b#.obj", "/h\u00fcte/\u6a21.ply", "/h\u00fc.stl",
                                 "/x.off", "/not\xFFutf8.obj"}));
}

TEST_F(DesktopDialogOnBus, RefusesWhatIsNoLocalFile) {
  for (const std::string uri : {"sftp://host/a.obj", "file://elsewhere/a.obj", "a.obj", "",
                                "file:///a%00b", "file:///a%2Fb", "file:///a%zz"}) {
    const DialogAnswer answer = answer_of_uris({"file:///good.obj", uri});
    EXPECT_EQ(answer.outcome, DialogOutcome::refused) << uri;
    EXPECT_TRUE(answer.problem.starts_with(uri + " is not a file on this computer"))
        << answer.problem;
    EXPECT_TRUE(answer.files.empty()) << uri;
  }
}

TEST_F(DesktopDialogOnBus, ReportsCancel) {
  const DialogAnswer answer = answer_of({{"version", 4}, {"response", 1}});
  EXPECT_EQ(answer.outcome, DialogOutcome::canceled);
  EXPECT_EQ(answer.problem, "");
}

TEST_F(DesktopDialogOnBus, ReportsFailures) {
  const std::string several = "file:///a.obj";
  for (const json& parameters :
       {json{{"version", 4}, {"response", 2}}, json{{"version", 4}, {"response", 77}},
        json{{"version", 4}, {"behavior", "refuse"}},
        json{{"version", 4}, {"behavior", "wrong types"}},
        json{{"version", 4}, {"behavior", "crash"}}, json{{"version", 4}},
        json{{"version", 4}, {"results", {{"uris", "text"}}}},
        json{{"version", 4}, {"results", {{"uris", {several, several}}}}}, json::object()}) {
    const DialogAnswer answer = answer_of(parameters);
    EXPECT_EQ(answer.outcome, DialogOutcome::failed) << parameters;
    EXPECT_NE(answer.problem, "") << parameters;
    EXPECT_EQ(answer.problem.find("GDBus"), std::string::npos) << answer.problem;
  }
}

TEST_F(DesktopDialogOnBus, IsNotAvailableAfterFailure) {
  const MockBus bus;
  const MockPortal portal(bus, {{"version", 4}, {"response", 2}});
  DesktopDialog desktop(nullptr);
  ASSERT_TRUE(becomes_available(desktop));
  desktop.open({.title = "Open"}, false);
  ASSERT_TRUE(wait_for_answer(desktop));
  EXPECT_FALSE(desktop.is_available());
}

TEST_F(DesktopDialogOnBus, AcceptsAnswersOfOddPortals) {
  for (const std::string behavior : {"early", "other handle"}) {
    const DialogAnswer answer = answer_of(
        {{"version", 1}, {"behavior", behavior}, {"results", {{"uris", {"file:///a.obj"}}}}});
    EXPECT_EQ(answer.files, Paths{"/a.obj"}) << behavior << ": " << answer.problem;
  }
}

TEST_F(DesktopDialogOnBus, IgnoresAnswerToOtherRequest) {
  const MockBus bus;
  const MockPortal portal(
      bus,
      {{"version", 4}, {"behavior", "wrong path"}, {"results", {{"uris", {"file:///a.obj"}}}}});
  DesktopDialog desktop(nullptr);
  desktop.open({.title = "Open"}, false);
  EXPECT_FALSE(portal.wait_for("OpenFile").is_null());
  std::this_thread::sleep_for(std::chrono::milliseconds(300));
  EXPECT_FALSE(desktop.take());
}

TEST_F(DesktopDialogOnBus, ReportsEndOfBus) {
  MockBus bus;
  const MockPortal portal(bus, {{"version", 4}, {"behavior", "wait"}});
  DesktopDialog desktop(nullptr);
  desktop.open({.title = "Open"}, false);
  ASSERT_FALSE(portal.wait_for("OpenFile").is_null());
  bus.kill();
  const auto answer = wait_for_answer(desktop);
  ASSERT_TRUE(answer);
  EXPECT_EQ(answer->outcome, DialogOutcome::failed);
  EXPECT_NE(answer->problem, "");
}

TEST_F(DesktopDialogOnBus, GivesUpOnCallWithoutReply) {
  const DialogAnswer answer = answer_of({{"version", 4}, {"behavior", "never reply"}});
  EXPECT_EQ(answer.outcome, DialogOutcome::failed);
  EXPECT_NE(answer.problem, "");
}

TEST_F(DesktopDialogOnBus, DestructionClosesOpenDialog) {
  for (const std::string behavior : {"wait", "never reply"}) {
    const MockBus bus;
    const MockPortal portal(bus, {{"version", 4}, {"behavior", behavior}});
    auto desktop = std::make_unique<DesktopDialog>(nullptr);
    desktop->open({.title = "Open"}, false);
    ASSERT_FALSE(portal.wait_for("OpenFile").is_null());
    const auto begin = std::chrono::steady_clock::now();
    desktop.reset();
    const double seconds = seconds_since(begin);
    EXPECT_LT(seconds, 3.0) << behavior;
    RecordProperty("milliseconds", std::to_string(1000.0 * seconds));
    EXPECT_FALSE(portal.wait_for("Close").is_null()) << behavior;
  }
}

TEST_F(DesktopDialogOnBus, ClosedDialogCanBeShownAgain) {
  const MockBus bus;
  const MockPortal portal(bus, {{"version", 4}, {"behavior", "wait"}});
  DesktopDialog desktop(nullptr);
  for (int i = 0; i < 3; ++i) {
    desktop.open({.title = "Open"}, false);
    EXPECT_TRUE(desktop.is_open());
    desktop.close();
    EXPECT_FALSE(desktop.is_open());
    EXPECT_FALSE(desktop.take());
  }
}

TEST_F(DesktopDialogOnBus, DestructionDoesNotWaitForHungBus) {
  MockBus bus;
  const MockPortal portal(bus, {{"version", 4}, {"behavior", "wait"}});
  auto desktop = std::make_unique<DesktopDialog>(nullptr);
  desktop->open({.title = "Open"}, false);
  ASSERT_FALSE(portal.wait_for("OpenFile").is_null());
  bus.freeze(true);
  const auto begin = std::chrono::steady_clock::now();
  desktop.reset();
  const double seconds = seconds_since(begin);
  bus.freeze(false);
  EXPECT_LT(seconds, 3.0);
}

TEST_F(DesktopDialogOnBus, OpenSendsOptions) {
  const MockBus bus;
  const MockPortal portal(bus, {{"version", 4}, {"behavior", "wait"}});
  DesktopDialog desktop(nullptr);
  desktop.open({.title = "\xFFOpen a model",
                .filters = {{.name = "STL", .patterns = {"*.stl", "*.s2"}}, {"All", {"*"}}},
                .folder = "/mod\xFF"
                          "els",
                .parent = "x11:1a2b"},
               true);
  const json call = portal.wait_for("OpenFile");
  ASSERT_FALSE(call.is_null());
  EXPECT_EQ(call["parent"], "x11:1a2b");
  EXPECT_EQ(call["title"], "\uFFFDOpen a model");
  json options = call["options"];
  options.erase("handle_token");
  const std::vector<int> folder{'/', 'm', 'o', 'd', 0xFF, 'e', 'l', 's', 0};
  const json pattern = json::array({0, "*.[sS][tT][lL]"});
  const json filters =
      json::array({json::array({"STL", json::array({pattern, json::array({0, "*.[sS]2"})})}),
                   json::array({"All", json::array({json::array({0, "*"})})})});
  EXPECT_EQ(
      options,
      (json{
          {"modal", true}, {"multiple", true}, {"current_folder", folder}, {"filters", filters}}));
}

TEST_F(DesktopDialogOnBus, OldPortalGetsNoFolderToOpen) {
  const MockBus bus;
  const MockPortal portal(bus, {{"version", 3}, {"behavior", "wait"}});
  DesktopDialog desktop(nullptr);
  desktop.open({.title = "Open", .folder = "/models"}, false);
  const json options = portal.wait_for("OpenFile")["options"];
  EXPECT_FALSE(options.contains("current_folder")) << options;
  EXPECT_FALSE(options.contains("multiple")) << options;
}

TEST_F(DesktopDialogOnBus, SaveSuggestsName) {
  const MockBus bus;
  const MockPortal portal(
      bus, {{"version", 1}, {"results", {{"uris", {"file:///out/bunny%20edited.obj"}}}}});
  DesktopDialog desktop(nullptr);
  desktop.save({.title = "Save", .filters = model_filters(), .folder = "."}, "bunny edited.obj");
  const auto answer = wait_for_answer(desktop);
  ASSERT_TRUE(answer);
  EXPECT_EQ(answer->outcome, DialogOutcome::chosen) << answer->problem;
  EXPECT_EQ(answer->files, Paths{"/out/bunny edited.obj"});
  const json options = portal.wait_for("SaveFile")["options"];
  EXPECT_EQ(options["current_name"], "bunny edited.obj");
  EXPECT_EQ(options["current_folder"][0], '/');  // the current folder, as an absolute path
  EXPECT_EQ(options["filters"].size(), model_filters().size());
  EXPECT_FALSE(options.contains("multiple"));
}

TEST(FileFilters, AreThoseOfFormats) {
  const std::vector<FileFilter> readable = model_filters();
  EXPECT_EQ(readable.front().name, "All models");
  EXPECT_EQ(readable.front().patterns, (std::vector<std::string>{"*.obj", "*.ply", "*.stl", "*.off",
                                                                 "*.gltf", "*.glb", "*.pm"}));
  ASSERT_EQ(readable.size(), 9U);
  EXPECT_EQ(readable[1].name, "Wavefront OBJ");
  EXPECT_EQ(readable[1].patterns, std::vector<std::string>{"*.obj"});
  EXPECT_EQ(readable.back().patterns, std::vector<std::string>{"*"});
}

}  // namespace
}  // namespace mesher::app
