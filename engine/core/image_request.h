#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>

namespace mesher {

/// An image that is to be decoded, by its index, and how much of it is needed.
struct ImageRequest {
  std::uint32_t image = 0;
  /// Pixels per side that are enough; infinity: all.
  float needed_side = std::numeric_limits<float>::infinity();
};

/// Returns how often an image can be halved while it keeps the needed pixels and loses no odd row
/// or column.
inline std::uint32_t halvings(std::uint32_t width, std::uint32_t height, float needed_side) {
  std::uint32_t count = 0;
  for (std::uint32_t sides = width | height; sides % 2 == 0 && sides > 0; sides /= 2) {
    const std::uint32_t half = std::min(width, height) >> (count + 1);
    if (static_cast<float>(half) < std::max(needed_side, 1.0F)) break;
    ++count;
  }
  return count;
}

}  // namespace mesher
