#include "app/cli/streams.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <iostream>

#include "app/files/paths.h"
#include "engine/core/error.h"
#include "engine/core/memory.h"
#include "engine/io/beginning.h"
#include "engine/io/format.h"
#include "engine/io/spool.h"

namespace mesher::app {
namespace {

constexpr std::size_t kPmBytes = 8;  // by which a progressive mesh is known

/// Returns whether a model's name says its format.
bool tells_format(const std::string& file) {
  return io::format_of(file) != nullptr;
}

std::string joined(const std::vector<std::string>& words) {
  return fmt::format("{}", fmt::join(words, ", "));
}

/// Returns whether the output's name ends in one of the formats of the command.
bool tells_format_of(const StreamNames& names) {
  const std::string extension = io::extension_of(*names.output);
  return names.output_tells_format ||
         (!extension.empty() &&
          std::ranges::find(names.formats, extension.substr(1)) != names.formats.end());
}

/// Returns the extension of an open file that is an input. Looks at no more than it needs, because
/// the writer of a progressive mesh may pause.
std::string known_by_beginning(const std::string& file) {
  const int descriptor = io::descriptor_of(file);
  std::string begin = io::peek(descriptor, kPmBytes, nullptr);
  if (io::format_of_beginning(begin) != ".pm")
    begin = io::peek(descriptor, io::kFormatBytes, nullptr);
  if (begin.empty()) throw InputError(file, 0, "is empty, or nothing that can be read");
  const std::string_view extension = io::format_of_beginning(begin);
  if (extension.empty()) {
    throw InputError(
        file, 0,
        "does not begin like any format; name its format by --format: " + io::readable_formats());
  }
  return std::string(extension);
}

}  // namespace

std::vector<std::string> written_formats(std::string_view command) {
  if (command == "render" || command == "view") return {"png", "webp"};
  if (command == "progressive") return {"pm"};
  std::vector<std::string> formats;
  for (const io::FormatInfo& format : io::formats()) {
    if (format.write != nullptr) formats.emplace_back(format.extension + 1);
  }
  if (command == "edit") formats.emplace_back("pm");
  return formats;
}

Streams::Streams(const StreamNames& names, const FormatArguments& formats) {
  std::string input_format = formats.input_format;
  bool is_format_used = formats.format.empty();
  for (std::string* const input : names.inputs) {
    if (*input == "-") *input = "/dev/stdin";
  }
  if (names.inputs.size() > 1 && io::is_open_file(*names.inputs[0]) &&
      io::descriptor_of(*names.inputs[0]) == io::descriptor_of(*names.inputs[1])) {
    throw UsageError("one pipe cannot be two models");
  }
  if (names.output != nullptr && !names.output->empty()) {
    if (*names.output == "-") *names.output = "/dev/stdout";
    if (!tells_format_of(names) && !formats.format.empty()) {
      if (std::ranges::find(names.formats, formats.format) == names.formats.end()) {
        throw UsageError(fmt::format("--format: this command writes {}, not {}",
                                     joined(names.formats), formats.format));
      }
      name_format(*names.output, formats.format);
      is_format_used = true;
    }
    const bool is_open = io::is_open_file(*names.output);
    if (is_open && !tells_format_of(names)) {
      throw UsageError(fmt::format("{}: name the format of the output by --format: {}",
                                   *names.output, joined(names.formats)));
    }
  }
  for (const std::string* const input : names.inputs) {
    std::string format = input_format;
    if (format.empty() && !is_format_used && !tells_format(*input)) format = formats.format;
    if (!formats.format.empty() && format == formats.format) is_format_used = true;
    open_input(*input, format);
  }
  if (!is_format_used)
    throw UsageError("--format: the names of input and output say their formats already");
  // Last, because only the destructor restores it.
  if (names.output != nullptr && io::descriptor_of(*names.output) == STDOUT_FILENO)
    stdout_ = std::cout.rdbuf(std::cerr.rdbuf());
}

Streams::~Streams() {
  if (stdout_ != nullptr) std::cout.rdbuf(stdout_);
}

void Streams::open_input(const std::string& file, const std::string& format) {
  if (!io::is_open_file(file)) {
    if (!format.empty()) name_format(find_model(file).string(), format);
    return;
  }
  const std::string extension = format.empty() ? known_by_beginning(file) : "." + format;
  named_.emplace_back(file, extension);
  if (extension != ".pm") io::spool(io::descriptor_of(file), file, nullptr);
}

void Streams::name_format(const std::string& file, const std::string& format) {
  named_.emplace_back(file, "." + format);
}

void refuse_stream(const std::string& file, const std::string& what) {
  if (io::is_open_file(file)) throw UsageError(what + ": cannot be used with the pipe " + file);
}

}  // namespace mesher::app
