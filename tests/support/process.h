#pragma once

#include <sys/types.h>

#include <string>
#include <vector>

namespace mesher::test {

struct Finished {
  int exit_code = -1;  ///< 128 + signal if a signal ended it
  std::string out;
  std::string err;
};

/// Runs a program to its end. Arguments are passed unchanged, without a shell. `environment` lists
/// "NAME=value" to set and "NAME" to unset.
Finished run_program(const std::vector<std::string>& arguments,
                     const std::vector<std::string>& environment = {});

/// A program that runs in parallel to the test. The destructor kills it if it has not ended.
class BackgroundProgram {
 public:
  /// `err`: a file for its messages; empty: they are those of the test.
  explicit BackgroundProgram(const std::vector<std::string>& arguments,
                             const std::vector<std::string>& environment = {},
                             int inherited_fd = -1, const std::string& err = {});
  ~BackgroundProgram();
  BackgroundProgram(const BackgroundProgram&) = delete;
  BackgroundProgram& operator=(const BackgroundProgram&) = delete;

  bool is_running();
  /// Sends it a signal, unless it has ended.
  void send(int signal);
  /// Ends it by SIGKILL, which it cannot notice.
  void kill_at_once();
  /// Waits up to `seconds` for its end. Returns its exit code, or -1 if it still runs.
  int wait(double seconds);

 private:
  pid_t pid_ = -1;
  int exit_code_ = -1;
};

}  // namespace mesher::test
