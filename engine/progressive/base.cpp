#include "engine/progressive/base.h"

#include <algorithm>

namespace mesher::progressive {
namespace {

// Three octaves to refine if the error allows it, otherwise two.
constexpr std::uint32_t kMostOfModel = 8;
constexpr std::uint32_t kAlwaysOfModel = 4;

}  // namespace

void choose_base(simplify::SimplifyOptions& options, std::uint32_t faces, double diagonal) {
  options.target_faces = std::clamp(faces / kMostOfModel, 1U, kUsualBaseFaces);
  options.stop_before_error = simplify::kFarFromInput * diagonal;
  options.stop_below_faces = (faces + kAlwaysOfModel - 1) / kAlwaysOfModel;
}

}  // namespace mesher::progressive
