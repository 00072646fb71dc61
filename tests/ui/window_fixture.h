#pragma once

#include <gtest/gtest.h>

#include <chrono>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <thread>
#include <vector>

#include "tests/ui/viewer_process.h"
#include "tests/ui/x_server.h"

namespace mesher::test {

using nlohmann::json;

/// A test with a display of its own, on which it opens viewers.
class WindowTest : public testing::Test {
 protected:
  static void SetUpTestSuite() { server_ = std::make_unique<XServer>(); }
  static void TearDownTestSuite() { server_.reset(); }

  static std::unique_ptr<ViewerProcess> open(std::vector<std::string> arguments) {
    return std::make_unique<ViewerProcess>(*server_, std::move(arguments));
  }
  static void quit(ViewerProcess& viewer) {
    viewer.key("q");
    EXPECT_EQ(viewer.wait_for_end(), 0);
  }
  /// A click as a hand makes it: ImGui sees the pointer arrive, the button go down, and come up
  /// where it went down. It reads the pointer once a frame: moved on at once, the release would be
  /// seen elsewhere.
  static void click(const ViewerProcess& viewer, int x, int y) {
    viewer.move(x, y);
    viewer.settle();
    viewer.press(1);
    std::this_thread::sleep_for(std::chrono::milliseconds(150));
    viewer.release(1);
    viewer.settle();
  }
  /// A drag along a slider as a hand makes it, for the same reason.
  static void slide(const ViewerProcess& viewer, int x0, int x1, int y) {
    viewer.move(x0, y);
    viewer.settle();
    viewer.press(1);
    std::this_thread::sleep_for(std::chrono::milliseconds(150));
    viewer.move(x1, y);
    viewer.settle();
    viewer.release(1);
    viewer.settle();
  }
  static double number(const json& state, const char* name) {
    return state["camera"][name].get<double>();
  }

  inline static std::unique_ptr<XServer> server_;
};

/// Waits until the state of `viewer`, called `s`, meets a condition.
#define EXPECT_REACHES(viewer, condition)                                       \
  EXPECT_TRUE((viewer).reaches([&](const json& s) { return bool(condition); })) \
      << #condition << "\n"                                                     \
      << (viewer).state().dump(2)

}  // namespace mesher::test
