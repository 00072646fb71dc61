#include "tests/ui/x_server.h"

#include <X11/Xatom.h>
#include <X11/Xlib.h>
#include <fcntl.h>
#include <poll.h>
#include <unistd.h>

#include <stdexcept>

namespace mesher::test {

XServer::XServer(const std::vector<std::string>& arguments) {
  int ends[2];
  if (pipe2(ends, O_CLOEXEC) != 0) throw std::runtime_error("pipe");
  std::vector<std::string> command{"Xvfb",      "-displayfd", std::to_string(ends[1]),
                                   "-screen",   "0",          "1280x900x24",
                                   "-nolisten", "tcp"};
  command.insert(command.end(), arguments.begin(), arguments.end());
  server_ = std::make_unique<BackgroundProgram>(command, std::vector<std::string>{}, ends[1]);
  close(ends[1]);
  std::string number;
  char byte = 0;
  pollfd readable{ends[0], POLLIN, 0};
  while (poll(&readable, 1, 30'000) == 1 && read(ends[0], &byte, 1) == 1 && byte != '\n') {
    number += byte;
  }
  close(ends[0]);
  if (number.empty()) throw std::runtime_error("Xvfb did not start (scripts/bootstrap test)");
  environment_ = "DISPLAY=:" + number;
}

std::string XServer::xdotool(std::vector<std::string> arguments) const {
  arguments.insert(arguments.begin(), "xdotool");
  const Finished run = run_program(arguments, {environment_});
  if (run.exit_code != 0) throw std::runtime_error("xdotool: " + run.err);
  return run.out;
}

void XServer::set_resources(const std::string& resources) const {
  Display* connection = XOpenDisplay(display().c_str());
  if (connection == nullptr) throw std::runtime_error("the display cannot be opened");
  XChangeProperty(connection, DefaultRootWindow(connection), XA_RESOURCE_MANAGER, XA_STRING, 8,
                  PropModeReplace, reinterpret_cast<const unsigned char*>(resources.data()),
                  static_cast<int>(resources.size()));
  // Without any client, the server would forget them.
  XSetCloseDownMode(connection, RetainPermanent);
  XCloseDisplay(connection);
}

}  // namespace mesher::test
