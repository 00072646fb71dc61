#include "app/document/words.h"

#include <fmt/format.h>

#include "engine/core/text.h"
#include "engine/simplify/options.h"

namespace mesher::app {

std::string far_from(const std::string& what, double percent) {
  return fmt::format("far from {}: {} of the diagonal (RMS)", what, percent_text(percent));
}

std::string stop_text(simplify::StopReason reason) {
  if (reason != simplify::StopReason::far_from_input) return std::string(describe(reason));
  return fmt::format("fewer faces would be further than {} of the diagonal from the input",
                     percent_text(100.0 * simplify::kFarFromInput));
}

}  // namespace mesher::app
