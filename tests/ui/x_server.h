#pragma once

#include <memory>
#include <string>
#include <vector>

#include "tests/support/process.h"

namespace mesher::test {

/// An Xvfb on a display number of its own choice. Throws std::runtime_error where it does not
/// start.
class XServer {
 public:
  XServer();

  /// "DISPLAY=:N"
  const std::string& environment() const { return environment_; }
  std::string display() const { return environment_.substr(environment_.find('=') + 1); }
  /// Runs xdotool on it; returns what it prints. Throws where it fails.
  std::string xdotool(std::vector<std::string> arguments) const;

 private:
  std::unique_ptr<BackgroundProgram> server_;
  std::string environment_;
};

}  // namespace mesher::test
