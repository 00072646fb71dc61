#include "engine/core/error.h"

#include <fmt/format.h>

namespace mesher {
namespace {

std::string located(std::string_view file, std::uint64_t line, std::string_view reason) {
  if (line == 0) return file.empty() ? std::string(reason) : fmt::format("{}: {}", file, reason);
  if (file.empty()) return fmt::format("line {}: {}", line, reason);
  return fmt::format("{}:{}: {}", file, line, reason);
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
