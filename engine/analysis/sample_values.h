#pragma once

#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "engine/analysis/surface_matches.h"
#include "engine/core/parallel.h"

namespace mesher::analysis {

/// Returns `measure(i)` for each sample, in their order. Parallel.
template <class Measure>
std::vector<float> values_at_samples(std::size_t samples, const Measure& measure) {
  constexpr std::size_t kSamplesPerChunk = 4096;
  std::vector<float> values(samples);
  parallel_for_each(samples, kSamplesPerChunk,
                    [&](std::uint32_t i) { values[i] = static_cast<float>(measure(i)); });
  return values;
}

/// Returns the least finite `difference(candidate)` of a sample's nearest points; infinity if none
/// is finite.
template <class Difference>
double least_difference(const SurfaceMatches& matches, std::size_t sample,
                        const Difference& difference) {
  double least = std::numeric_limits<double>::infinity();
  for (const SurfacePoint& candidate : matches.candidates(sample)) {
    const double d = difference(candidate);
    if (d < least) least = d;
  }
  return least;
}

}  // namespace mesher::analysis
