#pragma once

#include <memory>
#include <string>
#include <vector>

#include "tests/support/process.h"

namespace mesher::test {

/// An Xvfb server on a free display number. Throws std::runtime_error if it does not start.
class XServer {
 public:
  XServer() : XServer(std::vector<std::string>{}) {}

  /// Ends the server, as when a person logs out.
  void end() { server_.reset(); }
  /// `arguments`: further ones of Xvfb.
  explicit XServer(const std::vector<std::string>& arguments);

  /// "DISPLAY=:N"
  const std::string& environment() const { return environment_; }
  std::string display() const { return environment_.substr(environment_.find('=') + 1); }
  /// Runs xdotool on the display. Returns its output. Throws std::runtime_error if it fails.
  std::string xdotool(std::vector<std::string> arguments) const;
  /// Sets the resources of the display. Programs that start later take their scale from Xft.dpi.
  void set_resources(const std::string& resources) const;

 private:
  std::unique_ptr<BackgroundProgram> server_;
  std::string environment_;
};

}  // namespace mesher::test
