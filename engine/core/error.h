#pragma once

#include <cstdint>
#include <stdexcept>
#include <string>
#include <string_view>

namespace mesher {

/// The exit code of the program when an error ends it.
enum class ExitCode : int {
  done = 0,
  usage = 1,          ///< invalid command line
  bad_input = 2,      ///< an input file cannot be used
  machine_lacks = 3,  ///< missing Vulkan device, driver, display or memory
  output_failed = 4,  ///< a result cannot be written
  timed_out = 5,      ///< the time limit is over
};

/// An error outside the program's control: a file, a driver, the command line. A bug in the caller
/// is a MESHER_ASSERT instead, and an expected "no" is a return value. Caught only in `main`, in
/// command dispatch, and at the end of a background job.
class Error : public std::runtime_error {
 public:
  Error(ExitCode code, const std::string& message) : std::runtime_error(message), code_(code) {}
  ExitCode exit_code() const { return code_; }

 private:
  ExitCode code_;
};

/// Thrown for an invalid command line.
class UsageError : public Error {
 public:
  explicit UsageError(const std::string& message) : Error(ExitCode::usage, message) {}
};

/// Thrown for an input that cannot be used. `what()` is one line, "file:line: reason", without
/// ":line" if the format has no lines (line 0).
class InputError : public Error {
 public:
  InputError(std::string_view file, std::uint64_t line, std::string_view reason);
  explicit InputError(std::string_view reason) : InputError("", 0, reason) {}

  const std::string& file() const { return file_; }
  std::uint64_t line() const { return line_; }  ///< from 1; 0: none
  const std::string& reason() const { return reason_; }

 private:
  std::string file_;
  std::uint64_t line_;
  std::string reason_;
};

/// Thrown for a missing Vulkan device, GPU feature, display or memory.
class DeviceError : public Error {
 public:
  explicit DeviceError(const std::string& message) : Error(ExitCode::machine_lacks, message) {}
};

/// Thrown for an input that takes more memory than the person allows.
class LimitError : public Error {
 public:
  explicit LimitError(const std::string& message) : Error(ExitCode::bad_input, message) {}
};

/// Thrown for a result that cannot be written. `what()` is "file: reason".
class OutputError : public Error {
 public:
  OutputError(std::string_view file, std::string_view reason);
};

/// Thrown when a progress token was canceled; not a failure.
class Cancelled : public std::runtime_error {
 public:
  Cancelled() : std::runtime_error("canceled") {}
};

}  // namespace mesher
