#pragma once

#include <string>

namespace mesher::app {

/// Returns bytes as ASCII text: all but printable characters, and %, are written as %XX. File names
/// may hold any bytes, and JSON holds UTF-8 only.
std::string percent_encoded(const std::string& bytes);
/// The inverse. A % that no two hexadecimal digits follow stays as it is.
std::string percent_decoded(const std::string& text);

}  // namespace mesher::app
