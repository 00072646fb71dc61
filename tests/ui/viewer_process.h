#pragma once

#include <functional>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tests/support/process.h"
#include "tests/support/temp_folder.h"
#include "tests/ui/x_server.h"

namespace mesher::test {

/// A mesher with a window, under validation, and what its state log says.
class ViewerProcess {
 public:
  /// Waits until the first state is there. `model` and more arguments as on the command line.
  ViewerProcess(const XServer& server, std::vector<std::string> arguments);

  const TempFolder& folder() const { return folder_; }
  /// The last line of the state log.
  nlohmann::json state() const;
  /// Waits until the state meets `condition`; false after a while, then `state()` is where it
  /// stuck.
  bool reaches(const std::function<bool(const nlohmann::json&)>& condition) const;
  /// Waits until the picture has come to rest.
  void settle() const;
  void key(const std::string& keysym) const;
  /// Moves the pointer to a point of the window. This, `press` and `release` return when the viewer
  /// has seen it: what comes in one frame with what follows, ImGui may take for something else.
  void move(int x, int y) const;
  void press(int button) const;
  void release(int button) const;
  /// Steps of the wheel; up is to come nearer.
  void scroll_up(int steps) const { scroll(4, steps); }
  void scroll_down(int steps) const { scroll(5, steps); }
  /// Press, move in steps, release.
  void drag(int button, int x0, int y0, int x1, int y1) const;
  const std::string& window() const { return window_; }
  /// What is on the window, as a PNG file's pixels (RGBA).
  std::vector<std::uint8_t> screenshot() const;
  bool is_running() { return program_->is_running(); }
  /// Exit code once it has ended by itself; -1 where it does not.
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
