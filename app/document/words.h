#pragma once

#include <string>

#include "engine/simplify/report.h"

namespace mesher::app {

/// "far from the input: 12.3 % of the diagonal (RMS)", for "the input" as `what`.
std::string far_from(const std::string& what, double percent);

/// Why a simplification stopped, if its error limit is kFarFromInput of the diagonal.
std::string stop_text(simplify::StopReason reason);

}  // namespace mesher::app
