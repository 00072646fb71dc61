#pragma once

#include <algorithm>
#include <array>
#include <optional>
#include <string>
#include <vector>

#include "engine/mesh/ids.h"
#include "engine/simplify/cards.h"
#include "engine/simplify/options.h"
#include "engine/simplify/report.h"

namespace mesher::app {

/// The rules of the next simplification, as the panel shows them.
struct SimplifySettings {
  simplify::SimplifyOptions rules;  ///< those of kSimplifyRules; targets are set per edit
  float max_error_percent = 0.0F;   ///< of the diagonal; 0: no bound
  /// The mesh of the scene that is simplified; none: all. Set per edit.
  std::uint32_t mesh = kNone;

  friend bool operator==(const SimplifySettings&, const SimplifySettings&) = default;
};
inline constexpr std::array kSimplifyLimits{Option<SimplifySettings>{
    .key = "max-error",
    .label = "max error",
    .help =
        "upper bound on the distance from the model that the edit starts from, in percent of the "
        "diagonal; makes the edit several times slower",
    .member = &SimplifySettings::max_error_percent,
    .unit = "%",
    .special = {0.0, "no bound"}}};

/// What a simplification did, and why it stopped.
struct SimplifyOutcome {
  simplify::SimplifyReport report;
  double diagonal = 0.0;       ///< of the input's bounding box: percentages refer to it
  bool crosses_seams = false;  ///< the target could not be reached along the seams of attributes
  simplify::ThinnedCards cards;
  /// RMS distance from the model as it was opened (distance_from_input), in model units. None if
  /// the simplification started from that model, or if the result has so many faces that the
  /// distance is small.
  std::optional<double> error_from_opened{};

  double percent(double distance) const { return diagonal > 0.0 ? 100.0 * distance / diagonal : 0; }
  /// The larger of this step's error and the error of all steps, in percent of the diagonal.
  double error_percent() const {
    return percent(std::max(report.estimated_error, error_from_opened.value_or(0.0)));
  }
  bool is_far() const { return error_percent() > 100.0 * simplify::kFarFromInput; }
};

inline constexpr const char* kCrossesSeams =
    "seams of the attributes were crossed, because that changes less than to keep them";

}  // namespace mesher::app
