#pragma once

#include <filesystem>
#include <fstream>
#include <glm/vec2.hpp>
#include <string>

#include "app/document/session.h"

namespace mesher::app {

/// Where a window last saw the pointer, in pixels, and whether a button of it is down.
struct Pointer {
  glm::dvec2 at{0.0};
  bool is_pressed = false;
};

/// Writes the session's state as one line of JSON whenever it differs from the line before: how
/// scripts and window tests see what a key or a gesture did.
class StateLog {
 public:
  /// An empty path: writes nothing. Throws OutputError where the file cannot be made.
  explicit StateLog(const std::filesystem::path& file);
  /// `pointer`: null where there is no window. Throws OutputError where the line cannot be written.
  void note(const Session& session, const Pointer* pointer = nullptr);

 private:
  std::filesystem::path file_;
  std::ofstream out_;
  std::string last_;
};

}  // namespace mesher::app
