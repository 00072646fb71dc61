#pragma once

#include <vulkan/vulkan_core.h>

#include <filesystem>
#include <functional>
#include <glm/vec2.hpp>
#include <optional>
#include <string>
#include <vector>

#include "app/input/gestures.h"
#include "app/input/keys.h"
#include "engine/core/error.h"

struct GLFWwindow;

namespace mesher::app {

/// There is no display on which a window can be opened.
class NoDisplay : public DeviceError {
 public:
  using DeviceError::DeviceError;
};

/// Returns the size of a window that nobody chose: 1280 x 800 points, or less if the screen is
/// smaller. `scale`: units of the window per point. `room`: what desktop bars leave of the screen,
/// in those units; 0: not known.
glm::ivec2 default_window_size(float scale, const glm::ivec2& room);

/// A window and its events. There can be one at a time.
class Window {
 public:
  /// Event handlers; each may be empty. Positions are in pixels of the framebuffer.
  struct Events {
    std::function<void(const KeyPress&)> key;
    std::function<void(MouseButton, Modifiers, glm::dvec2 at)> press;
    std::function<void()> release;
    std::function<void(glm::dvec2 at)> move;
    std::function<void(double steps)> scroll;
    std::function<void(std::vector<std::filesystem::path>)> drop;
    std::function<void()> changed;  ///< resized, uncovered, focused, another scale: draw again
  };

  /// `size`: 0: the default. `ui_scale`: units of the window per point, for that default; 0: that
  /// of the monitor. Throws NoDisplay.
  Window(const glm::ivec2& size, float ui_scale, const std::string& title);
  ~Window();
  Window(const Window&) = delete;
  Window& operator=(const Window&) = delete;

  /// Call before ImGui installs its own callbacks, which pass events on to these.
  void set_events(Events events);
  GLFWwindow* handle() const { return window_; }
  glm::uvec2 framebuffer_size() const;
  /// The units of the window per point (a pixel at 96 dpi), as the desktop is set: with X11, by
  /// Xft.dpi. At least 0.5.
  float content_scale() const;
  /// Returns whether the person has closed the window since the last call. It stays open.
  bool take_close_request();
  void set_title(const std::string& title);
  /// The extensions that a Vulkan instance needs to present to a window. Throws DeviceError if
  /// Vulkan cannot present to windows.
  static std::vector<const char*> instance_extensions();
  VkSurfaceKHR create_surface(VkInstance instance) const;

  /// Sleeps until there are events, for at most `timeout_s` seconds (negative: without limit), and
  /// handles them.
  static void wait_events(double timeout_s);
  static void poll_events();
  /// Ends a wait, from any thread.
  static void wake();
  /// Seconds since the first window.
  static double time();

 private:
  struct Callbacks;
  glm::dvec2 to_pixels(double x, double y) const;
  glm::dvec2 cursor() const;

  GLFWwindow* window_ = nullptr;
  Events events_;
  std::optional<glm::dvec2> cursor_;  ///< of the last move
};

}  // namespace mesher::app
