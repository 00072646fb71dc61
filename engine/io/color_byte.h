#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace mesher::io {

/// Returns the byte of a color channel, which is from 0 to 1. Other values are clamped; not a
/// number gives 0.
inline std::uint8_t color_byte(float channel) {
  if (std::isnan(channel)) return 0;
  return static_cast<std::uint8_t>(std::lround(255.0F * std::clamp(channel, 0.0F, 1.0F)));
}

}  // namespace mesher::io
