#include "engine/progressive/base.h"

#include <algorithm>

namespace mesher::progressive {
namespace {

// Three octaves to refine if the error allows it, otherwise two.
constexpr std::uint32_t kMostOfModel = 8;
constexpr std::uint32_t kAlwaysOfModel = 4;
// Collapses that stay legal along seams run out early, and the last ones do the most harm: of 0.5,
// 1, 2 and 5 % of the diagonal, only the first left FlightHelmet intact.
constexpr double kMostErrorWithLines = 0.005;

}  // namespace

void choose_base(simplify::SimplifyOptions& options, std::uint32_t faces, double diagonal,
                 bool has_lines) {
  options.target_faces = std::clamp(faces / kMostOfModel, 1U, kUsualBaseFaces);
  options.stop_before_error =
      (has_lines ? kMostErrorWithLines : simplify::kFarFromInput) * diagonal;
  options.stop_below_faces = (faces + kAlwaysOfModel - 1) / kAlwaysOfModel;
}

}  // namespace mesher::progressive
