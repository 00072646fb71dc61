#include "engine/core/error.h"

namespace mesher {
namespace {

std::string located(std::string_view file, std::uint64_t line, std::string_view reason) {
  std::string text;
  if (!file.empty()) {
    text += file;
    if (line != 0) text += ":" + std::to_string(line);
    text += ": ";
  } else if (line != 0) {
    text += "line " + std::to_string(line) + ": ";
  }
  return text += reason;
}

}  // namespace

InputError::InputError(std::string_view file, std::uint64_t line, std::string_view reason)
    : Error(ExitCode::bad_input, located(file, line, reason)),
      file_(file),
      line_(line),
      reason_(reason) {}

OutputError::OutputError(std::string_view file, std::string_view reason)
    : Error(ExitCode::output_failed, located(file, 0, reason)) {}

}  // namespace mesher
