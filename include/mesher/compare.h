#pragma once

/// @file
/// @brief The distance between two surfaces.

#include <mesher/progress.h>

#include <cstdint>

namespace mesher {

/// How two surfaces are compared.
struct CompareOptions {
  std::uint64_t samples = 300'000;  ///< points per surface, spread evenly over its area
  ProgressCallback progress{};      ///< may be empty
};

/// The distance between two surfaces, in model units. Each figure is the larger of both directions.
struct Comparison {
  double rms = 0.0;          ///< root mean square, weighted by area
  double mean = 0.0;         ///< weighted by area
  double max = 0.0;          ///< over samples and vertices: a lower bound of the maximum
  double upper_bound = 0.0;  ///< certified: no point of either surface is farther from the other
  double diagonal = 0.0;     ///< of the first surface's bounding box, for percentages
};

}  // namespace mesher
