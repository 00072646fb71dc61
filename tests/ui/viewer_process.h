#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tests/support/process.h"
#include "tests/support/temp_folder.h"
#include "tests/ui/x_server.h"

namespace mesher::test {

/// A viewer that runs with the validation layer, and its state log.
class ViewerProcess {
 public:
  /// Waits for the first state. `arguments` as on the command line.
  /// `state_home`: for XDG_STATE_HOME; empty: a folder of its own. `bus`: address of the session
  /// bus; the default: none can be reached, so that the program shows its own dialogs.
  /// `environment`: as for run_program, besides all this.
  ViewerProcess(const XServer& server, std::vector<std::string> arguments,
                std::filesystem::path state_home = {},
                const std::string& bus = "unix:path=/nonexistent",
                const std::vector<std::string>& environment = {});
  /// Prints the messages of the program.
  ~ViewerProcess();
  ViewerProcess(const ViewerProcess&) = delete;
  ViewerProcess& operator=(const ViewerProcess&) = delete;

  const TempFolder& folder() const { return folder_; }
  /// The last line of the state log.
  nlohmann::json state() const;
  /// Waits until the state meets `condition`. Returns false after a timeout; `state()` then returns
  /// the last state.
  bool reaches(const std::function<bool(const nlohmann::json&)>& condition) const;
  /// Waits until the picture no longer changes.
  void settle() const;
  void key(const std::string& keysym) const;
  /// Moves the pointer to a point of the window. This, `press` and `release` return when the viewer
  /// has seen the event, because ImGui may misinterpret several events in one frame.
  void move(int x, int y) const;
  void press(int button) const;
  void release(int button) const;
  /// Turns the wheel by steps; up zooms in.
  void scroll_up(int steps) const { scroll(4, steps); }
  void scroll_down(int steps) const { scroll(5, steps); }
  /// Presses the button, moves in steps, and releases it.
  void drag(int button, int x0, int y0, int x1, int y1) const;
  const std::string& window() const { return window_; }
  /// Returns the pixels of the window, as X11 stores them.
  std::vector<std::uint8_t> screenshot() const;
  bool is_running() { return program_->is_running(); }
  /// Presses the close button of the window, as a window manager does.
  void press_close_button() const;
  /// The title of the window.
  std::string title() const;
  /// The messages of the program.
  std::string errors() const { return read_bytes(folder_ / "err"); }
  /// Ends the program by SIGKILL.
  void kill() { program_->kill_at_once(); }
  void send(int signal) { program_->send(signal); }
  /// Waits until the program ends. Returns its exit code, or -1 after a timeout.
  int wait_for_end() { return program_->wait(60.0); }

 private:
  void scroll(int button, int steps) const;
  void await_pointer(const char* what, const nlohmann::json& value) const;

  const XServer& server_;
  TempFolder folder_;
  std::unique_ptr<BackgroundProgram> program_;
  std::string window_;
};

}  // namespace mesher::test
