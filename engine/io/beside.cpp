#include "engine/io/beside.h"

#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <optional>
#include <system_error>

namespace mesher::io {
namespace {

/// Returns a relative reference with its %XX escapes decoded, or nothing if it is malformed.
std::optional<std::string> decode_uri(std::string_view uri) {
  std::string path;
  for (std::size_t i = 0; i < uri.size(); ++i) {
    if (uri[i] != '%') {
      path += uri[i];
      continue;
    }
    const std::string digits(uri.substr(i + 1, 2));
    char* end = nullptr;
    const long value = std::strtol(digits.c_str(), &end, 16);
    if (digits.size() != 2 || std::isxdigit(static_cast<unsigned char>(digits[0])) == 0 ||
        end != digits.c_str() + 2 || value <= 0) {
      return std::nullopt;
    }
    path += static_cast<char>(value);
    i += 2;
  }
  return path;
}

}  // namespace

bool stays_below(const std::filesystem::path& path) {
  if (path.empty() || path.is_absolute()) return false;
  return std::none_of(path.begin(), path.end(),
                      [](const std::filesystem::path& part) { return part == ".."; });
}

Beside find_beside(const std::filesystem::path& folder,
                   std::initializer_list<std::string> spellings) {
  Beside found;
  for (const std::string& name : spellings) {
    if (name.empty() || name.find('\0') != std::string::npos) continue;
    if (!stays_below(name)) {
      found.is_outside = true;
      continue;
    }
    std::error_code error;
    if (std::filesystem::is_regular_file(folder / name, error)) return {folder / name, name, false};
  }
  return found;
}

Beside find_named_beside(const std::filesystem::path& folder, std::string_view name) {
  std::string slashes(name);
  std::ranges::replace(slashes, '\\', '/');
  return find_beside(folder, {std::string(name), slashes});
}

Beside find_uri_beside(const std::filesystem::path& folder, std::string_view uri) {
  return find_beside(folder, {decode_uri(uri).value_or(std::string()), std::string(uri)});
}

}  // namespace mesher::io
