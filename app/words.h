#pragma once

#include <cstdint>
#include <string>

namespace mesher::app {

/// "1,234,567"
std::string with_commas(std::uint64_t number);

/// Six digits at most: "0.00123457".
std::string short_number(double value);

}  // namespace mesher::app
