#include "tests/ui/viewer_process.h"

#include <X11/Xlib.h>
#include <X11/Xutil.h>

#include <chrono>
#include <iostream>
#include <stdexcept>
#include <thread>

namespace mesher::test {
namespace {

using namespace std::chrono_literals;

// Sanitizers and a busy machine make the first frame slow. A test that passes never waits so long.
constexpr auto kPatience = 60s;

bool becomes_true(const std::function<bool()>& condition) {
  const auto end = std::chrono::steady_clock::now() + kPatience;
  while (std::chrono::steady_clock::now() < end) {
    if (condition()) return true;
    std::this_thread::sleep_for(20ms);
  }
  return false;
}

}  // namespace

ViewerProcess::ViewerProcess(const XServer& server, std::vector<std::string> arguments,
                             std::filesystem::path state_home, const std::string& bus,
                             const std::vector<std::string>& environment)
    : server_(server) {
  if (state_home.empty()) state_home = folder_.path();
  arguments.insert(arguments.begin(), MESHER_PROGRAM);
  arguments.insert(arguments.end(), {"--validation", "--state-log", folder_ / "state.jsonl"});
  std::vector<std::string> all{server.environment(),
                               "WAYLAND_DISPLAY",
                               "DBUS_SESSION_BUS_ADDRESS=" + bus,
                               "XDG_STATE_HOME=" + state_home.string(),
                               "XDG_CONFIG_HOME=" + (state_home / "config").string(),
                               "XDG_PICTURES_DIR=" + folder_.path().string()};
  all.insert(all.end(), environment.begin(), environment.end());
  program_ = std::make_unique<BackgroundProgram>(arguments, all, -1, folder_ / "err");
  if (!becomes_true([this] { return !state().is_null() || !is_running(); }) || !is_running()) {
    throw std::runtime_error("the viewer did not start: " + errors());
  }
  window_ = server.xdotool({"search", "--sync", "--name", "mesher"});
  window_ = window_.substr(0, window_.find('\n'));
  server.xdotool({"windowfocus", "--sync", window_});
}

ViewerProcess::~ViewerProcess() {
  program_.reset();
  std::cerr << errors();
}

nlohmann::json ViewerProcess::state() const {
  if (!std::filesystem::exists(folder_ / "state.jsonl")) return {};
  const std::string text = read_bytes(folder_ / "state.jsonl");
  const std::size_t end = text.rfind('\n');
  if (end == std::string::npos) return {};
  const std::size_t before = text.rfind('\n', end - 1);
  const std::size_t begin = before == std::string::npos ? 0 : before + 1;
  return nlohmann::json::parse(text.substr(begin, end - begin));
}

bool ViewerProcess::reaches(const std::function<bool(const nlohmann::json&)>& condition) const {
  return becomes_true([&] { return condition(state()); });
}

void ViewerProcess::settle() const {
  auto last = screenshot();
  becomes_true([&] {
    std::this_thread::sleep_for(150ms);
    auto now = screenshot();
    const bool is_still = now == last;
    last = std::move(now);
    return is_still;
  });
}

void ViewerProcess::await_pointer(const char* what, const nlohmann::json& value) const {
  if (!reaches([&](const nlohmann::json& s) { return s["pointer"][what] == value; })) {
    throw std::runtime_error("the viewer does not see the pointer " + value.dump());
  }
}

void ViewerProcess::key(const std::string& keysym) const {
  server_.xdotool({"key", keysym});
}

void ViewerProcess::move(int x, int y) const {
  server_.xdotool({"mousemove", "--window", window_, std::to_string(x), std::to_string(y)});
  await_pointer("at", {x, y});
}

void ViewerProcess::press(int button) const {
  server_.xdotool({"mousedown", std::to_string(button)});
  await_pointer("pressed", true);
}

void ViewerProcess::release(int button) const {
  server_.xdotool({"mouseup", std::to_string(button)});
  await_pointer("pressed", false);
}

void ViewerProcess::scroll(int button, int steps) const {
  server_.xdotool({"click", "--repeat", std::to_string(steps), std::to_string(button)});
}

void ViewerProcess::drag(int button, int x0, int y0, int x1, int y1) const {
  move(x0, y0);
  press(button);
  move((x0 + x1) / 2, (y0 + y1) / 2);
  move(x1, y1);
  release(button);
}

void ViewerProcess::press_close_button() const {
  Display* display = XOpenDisplay(server_.display().c_str());
  if (display == nullptr) throw std::runtime_error("XOpenDisplay");
  XEvent event{};
  event.xclient.type = ClientMessage;
  event.xclient.window = std::stoul(window_);
  event.xclient.message_type = XInternAtom(display, "WM_PROTOCOLS", False);
  event.xclient.format = 32;
  event.xclient.data.l[0] = static_cast<long>(XInternAtom(display, "WM_DELETE_WINDOW", False));
  XSendEvent(display, event.xclient.window, False, NoEventMask, &event);
  XCloseDisplay(display);
}

std::string ViewerProcess::title() const {
  std::string title = server_.xdotool({"getwindowname", window_});
  if (title.ends_with('\n')) title.pop_back();
  return title;
}

std::vector<std::uint8_t> ViewerProcess::screenshot() const {
  Display* display = XOpenDisplay(server_.display().c_str());
  if (display == nullptr) throw std::runtime_error("XOpenDisplay");
  const Window window = std::stoul(window_);
  XWindowAttributes attributes{};
  XGetWindowAttributes(display, window, &attributes);
  XImage* image = XGetImage(display, window, 0, 0, static_cast<unsigned>(attributes.width),
                            static_cast<unsigned>(attributes.height), AllPlanes, ZPixmap);
  if (image == nullptr) throw std::runtime_error("XGetImage");
  const std::vector<std::uint8_t> bytes(image->data,
                                        image->data + image->bytes_per_line * image->height);
  XDestroyImage(image);
  XCloseDisplay(display);
  return bytes;
}

}  // namespace mesher::test
