#include "tests/support/mock_desktop.h"

#include <signal.h>

#include <chrono>
#include <cstdlib>
#include <fstream>
#include <stdexcept>
#include <thread>
#include <utility>

namespace mesher::test {
namespace {

constexpr char kBusAddress[] = "DBUS_SESSION_BUS_ADDRESS";

/// Returns whether `holds` became true within a minute.
template <class Condition>
bool wait_until(const Condition& holds) {
  const auto end = std::chrono::steady_clock::now() + std::chrono::minutes(1);
  while (!holds()) {
    if (std::chrono::steady_clock::now() > end) return false;
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  return true;
}

std::string bus_configuration(const std::string& address, const std::string& pid_file,
                              bool answers) {
  return "<busconfig><type>session</type><listen>" + address + "</listen><pidfile>" + pid_file +
         "</pidfile><auth>EXTERNAL</auth><policy context=\"default\"><allow own=\"*\"/>"
         "<allow send_destination=\"*\"/>" +
         (answers ? "<allow receive_sender=\"*\"/>" : "") + "</policy></busconfig>";
}

}  // namespace

Variable::Variable(const char* name, const std::optional<std::string>& value) : name_(name) {
  if (const char* before = std::getenv(name)) before_ = before;
  set(value);
}

Variable::~Variable() {
  set(before_);
}

void Variable::set(const std::optional<std::string>& value) const {
  if (value) {
    setenv(name_, value->c_str(), 1);
  } else {
    unsetenv(name_);
  }
}

const std::string& python_with_dbusmock() {
  static const std::string found = [] {
    if (run_program({"dbus-daemon", "--version"}).exit_code != 0) return std::string{};
    // Debian's package is for Debian's Python, which need not be the first in PATH.
    for (const std::string python : {"python3", "/usr/bin/python3"}) {
      if (run_program({python, "-c", "import dbusmock, gi"}).exit_code == 0) return python;
    }
    return std::string{};
  }();
  return found;
}

MockBus::MockBus(bool answers)
    : address_("unix:path=" + (folder_ / "bus").string()), variable_(kBusAddress, address_) {
  const auto file = folder_.write(
      "bus.conf", bus_configuration(address_, (folder_ / "bus.pid").string(), answers));
  daemon_ = std::make_unique<BackgroundProgram>(
      std::vector<std::string>{"dbus-daemon", "--config-file=" + file.string(), "--nofork"});
  // The daemon writes the file when its socket listens.
  if (!wait_until([this] { return !read_bytes(folder_ / "bus.pid").empty(); })) {
    throw std::runtime_error("the bus did not start");
  }
}

void MockBus::freeze(bool on) {
  ::kill(std::stoi(read_bytes(folder_ / "bus.pid")), on ? SIGSTOP : SIGCONT);
}

MockPortal::MockPortal(const MockBus& bus, nlohmann::json parameters)
    : log_(bus.folder() / "events") {
  parameters["log"] = log_.string();
  program_ = std::make_unique<BackgroundProgram>(std::vector<std::string>{
      python_with_dbusmock(), "-m", "dbusmock", "--session", "--template",
      MESHER_SOURCE_DIR "/tests/support/mock_portal.py", "--parameters", parameters.dump(),
      "--logfile", (bus.folder() / "mock.log").string()});
  const nlohmann::json ready = wait_for("ready");
  if (ready.is_null()) throw std::runtime_error("the portal did not start");
  pid_ = ready["pid"].get<pid_t>();
}

std::vector<nlohmann::json> MockPortal::events() const {
  std::ifstream log(log_);
  std::vector<nlohmann::json> events;
  // A last line without its end is still being written.
  for (std::string line; std::getline(log, line) && !log.eof();) {
    events.push_back(nlohmann::json::parse(line));
  }
  return events;
}

nlohmann::json MockPortal::wait_for(const std::string& name) const {
  nlohmann::json found;
  wait_until([&] {
    for (const nlohmann::json& event : events()) {
      if (event["event"] == name) found = event;
    }
    return !found.is_null();
  });
  return found;
}

void MockPortal::freeze(bool on) {
  if (pid_ > 0 && program_->is_running()) ::kill(pid_, on ? SIGSTOP : SIGCONT);
}

}  // namespace mesher::test
