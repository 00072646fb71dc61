#pragma once

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tests/support/process.h"
#include "tests/support/temp_folder.h"

namespace mesher::test {

/// Runs the whole program from the command line, without a display. Files go into the test's own
/// folder.
class ProgramTest : public testing::Test {
 protected:
  Finished mesher(std::vector<std::string> arguments, std::vector<std::string> environment = {}) {
    arguments.insert(arguments.begin(), MESHER_PROGRAM);
    arguments.insert(arguments.begin(), {"env", "-C", folder_.path().string()});
    environment.insert(environment.end(), {"DISPLAY", "WAYLAND_DISPLAY"});
    return run_program(arguments, environment);
  }

  /// As above, with `--json`; returns the JSON. Fails the test if the program fails.
  nlohmann::json mesher_json(std::vector<std::string> arguments) {
    arguments.emplace_back("--json");
    const Finished run = mesher(std::move(arguments));
    EXPECT_EQ(run.exit_code, 0) << run.err;
    return nlohmann::json::parse(run.out, nullptr, false);
  }

  /// Runs a shell command in the test's folder; "mesher" is the program.
  Finished shell(const std::string& line) {
    return run_program({"sh", "-c",
                        "mesher() { " MESHER_PROGRAM " \"$@\"; }; cd '" + folder_.path().string() +
                            "' && " + line});
  }

  TempFolder folder_;
};

inline bool holds(const std::string& text, const std::string& words) {
  return text.find(words) != std::string::npos;
}

}  // namespace mesher::test
