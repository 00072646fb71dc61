#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <glm/gtc/type_precision.hpp>
#include <glm/vec4.hpp>

namespace mesher::io {

/// Returns the byte of a color channel, which is from 0 to 1. Other values are clamped; not a
/// number gives 0.
inline std::uint8_t color_byte(float channel) {
  if (std::isnan(channel)) return 0;
  return static_cast<std::uint8_t>(std::lround(255.0F * std::clamp(channel, 0.0F, 1.0F)));
}

inline glm::u8vec4 color_bytes(const glm::vec4& color) {
  return {color_byte(color.r), color_byte(color.g), color_byte(color.b), color_byte(color.a)};
}

}  // namespace mesher::io
