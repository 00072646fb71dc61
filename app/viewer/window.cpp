#include "app/viewer/window.h"

#include <dlfcn.h>
#define GLFW_INCLUDE_NONE
#define GLFW_INCLUDE_VULKAN
#include <GLFW/glfw3.h>
#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <glm/common.hpp>
#include <map>
#include <optional>

#include "engine/gpu/result.h"

namespace mesher::app {
namespace {

/// Returns the size of the screen without the bars of the desktop; 0 if it is not known.
glm::ivec2 room_on_screen() {
  glm::ivec2 room{0};
  GLFWmonitor* monitor = glfwGetPrimaryMonitor();
  if (monitor != nullptr) glfwGetMonitorWorkarea(monitor, nullptr, nullptr, &room.x, &room.y);
  return room;
}

std::string glfw_error() {
  const char* description = nullptr;
  glfwGetError(&description);
  return description == nullptr ? "unknown reason" : description;
}

/// Xlib calls this when the connection to the display has ended, and does not go on after it. Its
/// own handler ends the program with the exit code of a usage error.
int end_without_display(void*) {
  std::fputs(
      "mesher: the display was closed; mesher offers the unsaved edits when it starts again\n",
      stderr);
  // Destructors and those of static objects must not run: other threads may work with them.
  std::_Exit(static_cast<int>(ExitCode::machine_lacks));
}

/// GLFW may have loaded Xlib itself, so that the program is not linked with it.
void handle_closed_display() {
  void* const xlib = dlopen("libX11.so.6", RTLD_LAZY | RTLD_NOLOAD);
  if (xlib == nullptr) return;
  using SetHandler = void* (*)(int (*)(void*));
  const auto set = reinterpret_cast<SetHandler>(dlsym(xlib, "XSetIOErrorHandler"));
  if (set != nullptr) set(end_without_display);
  dlclose(xlib);
}

/// Returns the name of a key by its position on the keyboard; empty if shortcuts cannot use it.
std::string key_name(int key) {
  if ((key >= GLFW_KEY_A && key <= GLFW_KEY_Z) || (key >= GLFW_KEY_0 && key <= GLFW_KEY_9)) {
    std::string name(1, static_cast<char>(key));
    if (key >= GLFW_KEY_A) name[0] = static_cast<char>(name[0] - 'A' + 'a');
    return name;
  }
  if (key >= GLFW_KEY_F1 && key <= GLFW_KEY_F25) {
    return fmt::format("f{}", key - GLFW_KEY_F1 + 1);
  }
  if (key >= GLFW_KEY_KP_0 && key <= GLFW_KEY_KP_9) return std::to_string(key - GLFW_KEY_KP_0);
  static const std::map<int, std::string> kNamed{
      {GLFW_KEY_ESCAPE, "escape"},  {GLFW_KEY_TAB, "tab"},
      {GLFW_KEY_SPACE, "space"},    {GLFW_KEY_ENTER, "enter"},
      {GLFW_KEY_KP_ENTER, "enter"}, {GLFW_KEY_SLASH, "/"},
      {GLFW_KEY_LEFT, "left"},      {GLFW_KEY_RIGHT, "right"},
      {GLFW_KEY_UP, "up"},          {GLFW_KEY_DOWN, "down"},
      {GLFW_KEY_HOME, "home"},      {GLFW_KEY_END, "end"},
      {GLFW_KEY_PAGE_UP, "pageup"}, {GLFW_KEY_PAGE_DOWN, "pagedown"},
      {GLFW_KEY_LEFT_BRACKET, "["}, {GLFW_KEY_RIGHT_BRACKET, "]"},
      {GLFW_KEY_COMMA, ","},        {GLFW_KEY_PERIOD, "."},
      {GLFW_KEY_DELETE, "delete"},  {GLFW_KEY_KP_ADD, "+"},
      {GLFW_KEY_KP_SUBTRACT, "-"}};
  const auto found = kNamed.find(key);
  return found == kNamed.end() ? "" : found->second;
}

Modifiers modifiers_of(int modifiers) {
  return {.shift = (modifiers & GLFW_MOD_SHIFT) != 0,
          .control = (modifiers & GLFW_MOD_CONTROL) != 0};
}

MouseButton button_of(int button) {
  if (button == GLFW_MOUSE_BUTTON_LEFT) return MouseButton::left;
  return button == GLFW_MOUSE_BUTTON_MIDDLE ? MouseButton::middle : MouseButton::right;
}

/// Returns the key that was pressed, for shortcuts. Letters, plus and minus are taken from the text
/// printed on the key, so that w is w on every keyboard layout.
std::optional<KeyPress> key_press(int key, Modifiers modifiers) {
  const char* text = glfwGetKeyName(key, 0);
  const std::string printed = text == nullptr ? "" : text;
  const bool is_letter = key >= GLFW_KEY_A && key <= GLFW_KEY_Z;
  // On layouts where plus is Shift and "=", "=" alone also works.
  if (printed == "+" || printed == "=") return KeyPress{"+", false, modifiers.control};
  if (printed == "-") return KeyPress{"-", false, modifiers.control};
  const std::string name = is_letter && printed.size() == 1 ? printed : key_name(key);
  if (name.empty()) return std::nullopt;
  return KeyPress{name, modifiers.shift, modifiers.control};
}

}  // namespace

glm::ivec2 default_window_size(float scale, const glm::ivec2& room) {
  const glm::vec2 points{1280.0F, 800.0F};
  glm::ivec2 size(glm::round(points * scale));
  for (int axis = 0; axis < 2; ++axis) {
    if (room[axis] > 0) size[axis] = std::min(size[axis], room[axis]);
  }
  return size;
}

struct Window::Callbacks {
  static Window& of(GLFWwindow* window) {
    return *static_cast<Window*>(glfwGetWindowUserPointer(window));
  }
  static void key(GLFWwindow* window, int key, int, int action, int modifiers) {
    if (action != GLFW_PRESS) return;  // ignore repeats of a key that is held down
    const std::optional<KeyPress> press = key_press(key, modifiers_of(modifiers));
    Window& self = of(window);
    if (press && self.events_.key) self.events_.key(*press);
  }
  static void button(GLFWwindow* window, int button, int action, int modifiers) {
    Window& self = of(window);
    if (action == GLFW_RELEASE) {
      if (self.events_.release) self.events_.release();
      return;
    }
    if (self.events_.press) {
      self.events_.press(button_of(button), modifiers_of(modifiers), self.cursor());
    }
  }
  static void cursor(GLFWwindow* window, double x, double y) {
    Window& self = of(window);
    self.cursor_ = self.to_pixels(x, y);
    if (self.events_.move) self.events_.move(*self.cursor_);
  }
  static void scroll(GLFWwindow* window, double, double steps) {
    Window& self = of(window);
    if (self.events_.scroll) self.events_.scroll(steps);
  }
  static void drop(GLFWwindow* window, int count, const char** paths) {
    Window& self = of(window);
    if (self.events_.drop) self.events_.drop({paths, paths + count});
  }
  static void changed(GLFWwindow* window) {
    Window& self = of(window);
    if (self.events_.changed) self.events_.changed();
  }
};

Window::Window(const glm::ivec2& size, float ui_scale, const std::string& title) {
  if (glfwInit() != GLFW_TRUE) throw NoDisplay("no display (" + glfw_error() + ")");
  if (glfwVulkanSupported() != GLFW_TRUE) {
    glfwTerminate();
    throw DeviceError(
        "no Vulkan found: install a Vulkan loader and a driver (Debian: libvulkan1, "
        "mesa-vulkan-drivers)");
  }
  glfwWindowHint(GLFW_CLIENT_API, GLFW_NO_API);
  // The scale is known only once there is a window: show it in its final size.
  const bool is_sized = size.x > 0;
  const glm::ivec2 first = is_sized ? size : default_window_size(1.0F, {});
  glfwWindowHint(GLFW_VISIBLE, is_sized ? GLFW_TRUE : GLFW_FALSE);
  window_ = glfwCreateWindow(first.x, first.y, title.c_str(), nullptr, nullptr);
  if (window_ == nullptr) {
    const std::string reason = glfw_error();
    glfwTerminate();
    throw NoDisplay("cannot open a window (" + reason + ")");
  }
  glfwSetWindowUserPointer(window_, this);
  handle_closed_display();
  if (is_sized) return;
  const glm::ivec2 chosen =
      default_window_size(ui_scale > 0.0F ? ui_scale : content_scale(), room_on_screen());
  glfwSetWindowSize(window_, chosen.x, chosen.y);
  glfwShowWindow(window_);
}

Window::~Window() {
  glfwDestroyWindow(window_);
  glfwTerminate();
}

void Window::set_events(Events events) {
  events_ = std::move(events);
  glfwSetKeyCallback(window_, Callbacks::key);
  glfwSetMouseButtonCallback(window_, Callbacks::button);
  glfwSetCursorPosCallback(window_, Callbacks::cursor);
  glfwSetScrollCallback(window_, Callbacks::scroll);
  glfwSetDropCallback(window_, Callbacks::drop);
  glfwSetWindowRefreshCallback(window_, Callbacks::changed);
  glfwSetFramebufferSizeCallback(window_, [](GLFWwindow* w, int, int) { Callbacks::changed(w); });
  glfwSetWindowContentScaleCallback(window_,
                                    [](GLFWwindow* w, float, float) { Callbacks::changed(w); });
  glfwSetWindowIconifyCallback(window_, [](GLFWwindow* w, int) { Callbacks::changed(w); });
  glfwSetWindowFocusCallback(window_, [](GLFWwindow* w, int) { Callbacks::changed(w); });
}

glm::dvec2 Window::to_pixels(double x, double y) const {
  int width = 1;
  int height = 1;
  glfwGetWindowSize(window_, &width, &height);
  const glm::uvec2 pixels = framebuffer_size();
  return {x * pixels.x / std::max(width, 1), y * pixels.y / std::max(height, 1)};
}

// The position at the current event. By now the pointer may have moved on.
glm::dvec2 Window::cursor() const {
  if (cursor_) return *cursor_;
  double x = 0.0;
  double y = 0.0;
  glfwGetCursorPos(window_, &x, &y);
  return to_pixels(x, y);
}

glm::uvec2 Window::framebuffer_size() const {
  int width = 0;
  int height = 0;
  glfwGetFramebufferSize(window_, &width, &height);
  return {static_cast<unsigned>(width), static_cast<unsigned>(height)};
}

float Window::content_scale() const {
  float scale = 1.0F;
  glfwGetWindowContentScale(window_, &scale, nullptr);
  int width = 1;
  glfwGetWindowSize(window_, &width, nullptr);
  // Where the desktop itself enlarges the window's units, as Wayland does, they stay small.
  const float pixels = static_cast<float>(framebuffer_size().x) / std::max(1.0F, float(width));
  return std::max(0.5F, scale / std::max(1.0F, pixels));
}

bool Window::take_close_request() {
  const bool is_requested = glfwWindowShouldClose(window_) == GLFW_TRUE;
  glfwSetWindowShouldClose(window_, GLFW_FALSE);
  return is_requested;
}

void Window::set_title(const std::string& title) {
  glfwSetWindowTitle(window_, title.c_str());
}

std::vector<const char*> Window::instance_extensions() {
  std::uint32_t count = 0;
  const char** names = glfwGetRequiredInstanceExtensions(&count);
  if (names == nullptr)
    throw DeviceError("Vulkan cannot draw into windows on this display: " + glfw_error());
  return {names, names + count};
}

VkSurfaceKHR Window::create_surface(VkInstance instance) const {
  VkSurfaceKHR surface = VK_NULL_HANDLE;
  gpu::check(glfwCreateWindowSurface(instance, window_, nullptr, &surface),
             "glfwCreateWindowSurface");
  return surface;
}

void Window::wait_events(double timeout_s) {
  if (timeout_s < 0.0) {
    glfwWaitEvents();
  } else {
    glfwWaitEventsTimeout(timeout_s);
  }
}

void Window::poll_events() {
  glfwPollEvents();
}

void Window::wake() {
  glfwPostEmptyEvent();
}

double Window::time() {
  return glfwGetTime();
}

}  // namespace mesher::app
