#include "engine/io/extension.h"

#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <map>
#include <utility>

namespace mesher::io {
namespace {

/// The extensions of NamedFormats.
std::map<std::filesystem::path, std::string>& named_extensions() {
  static std::map<std::filesystem::path, std::string> extensions;
  return extensions;
}

}  // namespace

std::string extension_of(const std::filesystem::path& file) {
  const auto named = named_extensions().find(file);
  if (named != named_extensions().end()) return named->second;
  std::string extension = file.extension().string();
  std::ranges::transform(extension, extension.begin(),
                         [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return extension;
}

int descriptor_of(const std::filesystem::path& file) {
  if (file == "/dev/stdin") return STDIN_FILENO;
  if (file == "/dev/stdout") return STDOUT_FILENO;
  if (file == "/dev/stderr") return STDERR_FILENO;
  if (file.parent_path() != "/dev/fd" && file.parent_path() != "/proc/self/fd") return -1;
  const std::string number = file.filename().string();
  int descriptor = -1;
  const char* const end = number.data() + number.size();
  const auto [stop, error] = std::from_chars(number.data(), end, descriptor);
  return error == std::errc() && stop == end ? descriptor : -1;
}

bool is_open_file(const std::filesystem::path& file) {
  return descriptor_of(file) >= 0;
}

NamedFormat::NamedFormat(std::filesystem::path file, std::string extension)
    : file_(std::move(file)) {
  named_extensions()[file_] = std::move(extension);
}

NamedFormat::~NamedFormat() {
  named_extensions().erase(file_);
}

}  // namespace mesher::io
