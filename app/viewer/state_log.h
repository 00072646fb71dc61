#pragma once

#include <filesystem>
#include <fstream>
#include <glm/vec2.hpp>
#include <string>

#include "app/document/session.h"
#include "app/ui/panels.h"

namespace mesher::app {

/// The last position of the pointer in a window, in pixels, and whether a button is pressed.
struct Pointer {
  glm::dvec2 at{0.0};
  bool is_pressed = false;
};

/// Writes the session's state as one line of JSON whenever it differs from the line before. Scripts
/// and window tests read from it the effect of a key or a gesture.
class StateLog {
 public:
  /// An empty path: writes nothing. Throws OutputError if the file cannot be created.
  explicit StateLog(const std::filesystem::path& file);
  /// `pointer`: null if there is no window. `widgets`: null if there are no panels. Throws
  /// OutputError if the line cannot be written.
  void note(const Session& session, const Pointer* pointer = nullptr,
            const WidgetAreas* widgets = nullptr);

 private:
  std::filesystem::path file_;
  std::ofstream out_;
  std::string last_;
};

}  // namespace mesher::app
