#include "app/document/words.h"

#include <cstdio>

#include "engine/simplify/options.h"

namespace mesher::app {

std::string with_commas(std::uint64_t number) {
  std::string text = std::to_string(number);
  for (std::size_t at = text.size(); at > 3; at -= 3)
    text.insert(at - 3, 1, ',');
  return text;
}

std::string short_number(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.6g", value);
  return text;
}

std::string percent_text(double percent) {
  char text[32];
  std::snprintf(text, sizeof text, "%.3g %%", percent);
  return text;
}

std::string far_from(const std::string& what, double percent) {
  return "far from " + what + ": " + percent_text(percent) + " of the diagonal (RMS)";
}

std::string stop_text(simplify::StopReason reason) {
  if (reason != simplify::StopReason::far_from_input) return std::string(describe(reason));
  return "fewer faces would be further than " + percent_text(100.0 * simplify::kFarFromInput) +
         " of the diagonal from the input";
}

}  // namespace mesher::app
