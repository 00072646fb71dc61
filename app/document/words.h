#pragma once

#include <cstdint>
#include <string>

#include "engine/simplify/report.h"

namespace mesher::app {

/// "1,234,567"
std::string with_commas(std::uint64_t number);

/// A number with at most six significant digits: "0.00123457".
std::string short_number(double value);

/// "12.3 %": three significant digits.
std::string percent_text(double percent);

/// "far from the input: 12.3 % of the diagonal (RMS)", for "the input" as `what`.
std::string far_from(const std::string& what, double percent);

/// Why a simplification stopped, if its error limit is kFarFromInput of the diagonal.
std::string stop_text(simplify::StopReason reason);

}  // namespace mesher::app
