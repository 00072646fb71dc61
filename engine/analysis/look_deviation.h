#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "engine/analysis/attributed_surface.h"
#include "engine/analysis/spread.h"
#include "engine/core/progress.h"

namespace mesher::analysis {

struct LookOptions {
  std::uint64_t samples = 300'000;  ///< per surface, spread evenly over the area
  Progress* progress = nullptr;
};

/// How much the look of a surface deviates from that of the original.
struct LookDeviation {
  std::optional<TwoSidedSpread> uv_slide;  ///< in texels
  std::vector<std::string> not_measured;   ///< what is missing, and why, for users
};

/// Measures the look of `b` against that of the original `a`, at samples of both surfaces. The same
/// for any number of threads. O(samples log F) expected, parallel. Throws Cancelled. Pre: both
/// meshes have faces.
LookDeviation look_deviation(const AttributedSurface& a, const AttributedSurface& b,
                             const LookOptions& options = {});

}  // namespace mesher::analysis
