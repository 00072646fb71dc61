#pragma once

#include <cstddef>
#include <cstdint>

#include "engine/core/array.h"

namespace mesher {

/// An 8-bit RGBA image, sRGB-encoded, top row first, rows without padding.
struct Image {
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  Array<std::uint8_t> rgba;  ///< 4 * width * height

  const std::uint8_t* pixel(std::uint32_t x, std::uint32_t y) const {
    return rgba.data() + 4 * (static_cast<std::size_t>(y) * width + x);
  }
};

}  // namespace mesher
