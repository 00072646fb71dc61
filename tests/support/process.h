#pragma once

#include <sys/types.h>

#include <string>
#include <vector>

namespace mesher::test {

struct Finished {
  int exit_code = -1;  ///< 128 + signal where a signal ended it
  std::string out;
  std::string err;
};

/// Runs a program to its end; arguments are passed as they are, no shell between. `environment`
/// lists "NAME=value" to set and "NAME" to unset.
Finished run_program(const std::vector<std::string>& arguments,
                     const std::vector<std::string>& environment = {});

/// A program that runs beside the test; killed with the object if it has not ended by then.
class BackgroundProgram {
 public:
  explicit BackgroundProgram(const std::vector<std::string>& arguments,
                             const std::vector<std::string>& environment = {},
                             int inherited_fd = -1);
  ~BackgroundProgram();
  BackgroundProgram(const BackgroundProgram&) = delete;
  BackgroundProgram& operator=(const BackgroundProgram&) = delete;

  bool is_running();
  /// Waits up to `seconds` for it to end; its exit code, or -1 where it still runs.
  int wait(double seconds);

 private:
  pid_t pid_ = -1;
  int exit_code_ = -1;
};

}  // namespace mesher::test
