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

/// Returns whether a name begins with a scheme of an address. One letter is a drive of Windows.
bool is_address(std::string_view name) {
  const std::size_t end = name.find("://");
  if (end == std::string_view::npos || end < 2) return false;
  return std::ranges::all_of(name.substr(0, end), [](unsigned char c) {
    return std::isalnum(c) != 0 || c == '+' || c == '-' || c == '.';
  });
}

}  // namespace

std::string_view Beside::reason() const {
  if (is_address) return "mesher does not fetch from the network";
  return is_outside ? "not opened, because it is outside of the model's folder"
                    : "there is no such file";
}

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
    found.is_address |= is_address(name);
    if (!stays_below(name)) {
      found.is_outside = true;
      continue;
    }
    std::error_code error;
    if (std::filesystem::is_regular_file(folder / name, error))
      return {.file = folder / name, .relative = name};
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
