#pragma once

/// @file
/// @brief The exceptions of the library.

#include <mesher/export.h>

#include <cstdint>
#include <stdexcept>
#include <string>
#include <string_view>

namespace mesher {

/// The exit code of the program when an error ends it. Other programs may use the same.
enum class ExitCode : int {
  done = 0,           ///< no error
  usage = 1,          ///< invalid command line
  bad_input = 2,      ///< an input file cannot be used
  machine_lacks = 3,  ///< missing Vulkan device, driver, display or memory
  output_failed = 4,  ///< a result cannot be written
  timed_out = 5,      ///< the time limit is over
};

/// An error outside the program's control: a file, a driver, the command line. A bug in the caller
/// is an assertion instead, and an expected "no" is a return value.
class MESHER_API Error : public std::runtime_error {
 public:
  /// Makes an error with a message of one line.
  Error(ExitCode code, const std::string& message) : std::runtime_error(message), code_(code) {}
  /// Returns the exit code of a program that ends with this error.
  ExitCode exit_code() const { return code_; }

 private:
  ExitCode code_;
};

/// Thrown for an argument that cannot be used, such as an unknown file extension.
class MESHER_API UsageError : public Error {
 public:
  /// Makes an error with a message of one line.
  explicit UsageError(const std::string& message) : Error(ExitCode::usage, message) {}
};

/// Thrown for an input that cannot be used. `what()` is one line, "file:line: reason", without
/// ":line" if the format has no lines (line 0).
class MESHER_API InputError : public Error {
 public:
  /// Makes an error about a line of a file; line 0: about the file.
  InputError(std::string_view file, std::uint64_t line, std::string_view reason);
  /// Makes an error that names no file.
  explicit InputError(std::string_view reason) : InputError("", 0, reason) {}

  /// Returns the name of the file; empty: the input is not a file.
  const std::string& file() const { return file_; }
  /// Returns the line, from 1; 0: none.
  std::uint64_t line() const { return line_; }
  /// Returns the message without file and line.
  const std::string& reason() const { return reason_; }

 private:
  std::string file_;
  std::uint64_t line_;
  std::string reason_;
};

/// Thrown for a missing Vulkan device, GPU feature, display or memory.
class MESHER_API DeviceError : public Error {
 public:
  /// Makes an error with a message of one line.
  explicit DeviceError(const std::string& message) : Error(ExitCode::machine_lacks, message) {}
};

/// Thrown for an input that takes more memory than the person allows.
class MESHER_API LimitError : public Error {
 public:
  /// Makes an error with a message of one line.
  explicit LimitError(const std::string& message) : Error(ExitCode::bad_input, message) {}
};

/// Thrown for a result that cannot be written. `what()` is "file: reason".
class MESHER_API OutputError : public Error {
 public:
  /// Makes an error about a file.
  OutputError(std::string_view file, std::string_view reason);
};

/// Thrown by an operation that was canceled; not a failure.
class MESHER_API Cancelled : public std::runtime_error {
 public:
  /// Makes the exception.
  Cancelled() : std::runtime_error("canceled") {}
};

}  // namespace mesher
