#pragma once

#include <filesystem>
#include <fstream>
#include <string>

#include "app/session.h"

namespace mesher::app {

/// Writes the session's state as one line of JSON whenever it differs from the line before: how
/// scripts and window tests see what a key or a gesture did.
class StateLog {
 public:
  /// An empty path: writes nothing. Throws OutputError where the file cannot be made.
  explicit StateLog(const std::filesystem::path& file);
  /// Throws OutputError where the line cannot be written.
  void note(const Session& session);

 private:
  std::filesystem::path file_;
  std::ofstream out_;
  std::string last_;
};

}  // namespace mesher::app
