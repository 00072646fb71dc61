#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <glm/vec2.hpp>
#include <glm/vec4.hpp>
#include <memory>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <vector>

#include "tests/ui/viewer_process.h"
#include "tests/ui/x_server.h"

namespace mesher::test {

using nlohmann::json;

/// A test suite with its own display, on which the tests open viewers.
class WindowTest : public testing::Test {
 protected:
  static void SetUpTestSuite() { server_ = std::make_unique<XServer>(); }
  static void TearDownTestSuite() { server_.reset(); }

  static std::unique_ptr<ViewerProcess> open(std::vector<std::string> arguments,
                                             const std::filesystem::path& state_home = {}) {
    return std::make_unique<ViewerProcess>(*server_, std::move(arguments), state_home);
  }
  /// Quits, and discards edits.
  static void quit(ViewerProcess& viewer) {
    const bool is_unsaved = viewer.state()["unsaved"].get<bool>();
    viewer.key("q");
    if (is_unsaved) {
      EXPECT_TRUE(viewer.reaches([](const json& s) { return s["question"] == "unsaved"; }));
      viewer.key("Delete");
    }
    EXPECT_EQ(viewer.wait_for_end(), 0);
  }
  static void click(const ViewerProcess& viewer, int x, int y) {
    viewer.move(x, y);
    viewer.settle();
    viewer.press(1);
    viewer.release(1);
    viewer.settle();
  }
  /// The place of a widget, such as "panel/remove 10 %", once it is there.
  static glm::dvec4 place_of(const ViewerProcess& viewer, const std::string& widget) {
    if (!viewer.reaches([&](const json& s) {
          return s.contains("widgets") && s["widgets"].contains(widget);
        })) {
      throw std::runtime_error("there is no widget " + widget + " in " +
                               viewer.state()["widgets"].dump());
    }
    const json place = viewer.state()["widgets"][widget];
    return {place[0], place[1], place[2], place[3]};
  }
  /// Clicks a widget, in the middle of its height, at a share of its width.
  static void click(const ViewerProcess& viewer, const std::string& widget, double share = 0.5) {
    viewer.settle();
    const glm::dvec4 place = place_of(viewer, widget);
    click(viewer, static_cast<int>(place.x + share * (place.z - place.x)),
          static_cast<int>((place.y + place.w) / 2));
  }
  /// A point of a slider, at a share of its length.
  static glm::ivec2 point_of(const ViewerProcess& viewer, const std::string& slider, double share) {
    const glm::dvec4 place = place_of(viewer, slider);
    constexpr double kHalfKnob = 9.0;
    return {place.x + kHalfKnob + share * (place.z - place.x - 2 * kHalfKnob),
            (place.y + place.w) / 2};
  }
  /// Drags the knob of a slider from one share of its length to another.
  static void slide(const ViewerProcess& viewer, const std::string& slider, double from,
                    double to) {
    viewer.settle();
    const glm::ivec2 start = point_of(viewer, slider, from);
    slide(viewer, start.x, point_of(viewer, slider, to).x, start.y);
  }
  /// Drags along a slider. While it is held, the window draws all the time, and does not settle.
  static void slide(const ViewerProcess& viewer, int x0, int x1, int y) {
    viewer.move(x0, y);
    viewer.settle();
    viewer.press(1);
    viewer.move(x1, y);
    viewer.release(1);
    viewer.settle();
  }
  static double number(const json& state, const char* name) {
    return state["camera"][name].get<double>();
  }

  inline static std::unique_ptr<XServer> server_;
};

/// Expects that the state of `viewer`, called `s`, meets a condition before a timeout.
#define EXPECT_REACHES(viewer, condition)                                       \
  EXPECT_TRUE((viewer).reaches([&](const json& s) { return bool(condition); })) \
      << #condition << "\n"                                                     \
      << (viewer).state().dump(2)

}  // namespace mesher::test
