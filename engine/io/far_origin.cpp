#include "engine/io/far_origin.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <glm/common.hpp>
#include <limits>

namespace mesher::io {
namespace {

/// Half the distance of neighboring floats, relative to the power of two below them.
constexpr double kFloatError = 1.0 / (1 << 24);

}  // namespace

glm::dvec3 choose_origin(const Array<glm::vec3>& positions, double error) {
  if (!(error > 0.0)) return glm::dvec3(0.0);
  glm::dvec3 low(std::numeric_limits<double>::max());
  glm::dvec3 high(std::numeric_limits<double>::lowest());
  for (const glm::vec3& p : positions) {
    if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z)) continue;
    low = glm::min(low, glm::dvec3(p));
    high = glm::max(high, glm::dvec3(p));
  }
  if (low.x > high.x) return glm::dvec3(0.0);
  const glm::dvec3 size = high - low;
  const double extent = std::max({size.x, size.y, size.z});
  if (error <= extent * kFloatError) return glm::dvec3(0.0);
  const glm::dvec3 center = low + 0.5 * size;
  // Points that differ by less than their floats do are about that far apart.
  const double least =
      std::max({std::abs(center.x), std::abs(center.y), std::abs(center.z)}) * kFloatError;
  const double grid = std::exp2(std::floor(std::log2(0.5 * std::max(extent, least))));
  if (!std::isnormal(grid)) return glm::dvec3(0.0);
  return glm::dvec3(std::round(center.x / grid), std::round(center.y / grid),
                    std::round(center.z / grid)) *
         grid;
}

char* write_far_coordinate(const FarCoordinate& coordinate, char* begin, char* end) {
  const double value = coordinate.value();
  // A fixed number of decimals is short only for numbers that have few digits before the point.
  constexpr double kMostFixed = 1e15;
  constexpr int kMostDecimals = 8;
  for (int decimals = 0; std::abs(value) < kMostFixed && decimals <= kMostDecimals; ++decimals) {
    char* const last = std::to_chars(begin, end, value, std::chars_format::fixed, decimals).ptr;
    double written = 0.0;
    std::from_chars(begin, last, written);
    if (static_cast<float>(written - coordinate.origin) == coordinate.local) return last;
  }
  return std::to_chars(begin, end, value).ptr;
}

}  // namespace mesher::io
