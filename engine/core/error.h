#pragma once

#include <cstdint>
#include <stdexcept>
#include <string>
#include <string_view>

namespace mesher {

/// What the program's exit code says when an error ends it.
enum class ExitCode : int {
  done = 0,
  usage = 1,          ///< the command line makes no sense
  bad_input = 2,      ///< an input file cannot be used
  machine_lacks = 3,  ///< no Vulkan device, no memory
  output_failed = 4,  ///< a result cannot be written
};

/// The world failed: a file, a driver, the caller's words. Never a caller's bug (that is
/// MESHER_ASSERT) and never an ordinary "no" (that is a value). Caught only in `main`, at command
/// dispatch, and where a background job ends.
class Error : public std::runtime_error {
 public:
  Error(ExitCode code, const std::string& message) : std::runtime_error(message), code_(code) {}
  ExitCode exit_code() const { return code_; }

 private:
  ExitCode code_;
};

/// The command line makes no sense.
class UsageError : public Error {
 public:
  explicit UsageError(const std::string& message) : Error(ExitCode::usage, message) {}
};

/// An input cannot be used. `what()` is one line: "file:line: reason", without ":line" where the
/// format has no lines (line 0).
class InputError : public Error {
 public:
  InputError(std::string_view file, std::uint64_t line, std::string_view reason);
  explicit InputError(std::string_view reason) : InputError("", 0, reason) {}

  const std::string& file() const { return file_; }
  std::uint64_t line() const { return line_; }  ///< counted from 1; 0: no line
  const std::string& reason() const { return reason_; }

 private:
  std::string file_;
  std::uint64_t line_;
  std::string reason_;
};

/// The machine lacks something: a Vulkan device, a feature, memory, a display.
class DeviceError : public Error {
 public:
  explicit DeviceError(const std::string& message) : Error(ExitCode::machine_lacks, message) {}
};

/// A result cannot be written. `what()` is "file: reason".
class OutputError : public Error {
 public:
  OutputError(std::string_view file, std::string_view reason);
};

/// A progress token was cancelled; not a failure.
class Cancelled : public std::runtime_error {
 public:
  Cancelled() : std::runtime_error("cancelled") {}
};

}  // namespace mesher
