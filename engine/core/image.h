#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>

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

/// An image whose pixels another owns.
struct ImageView {
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  const std::uint8_t* rgba = nullptr;

  ImageView() = default;
  ImageView(std::uint32_t w, std::uint32_t h, const std::uint8_t* pixels)
      : width(w), height(h), rgba(pixels) {}
  /// Any image can be viewed, so the conversion is implicit.
  ImageView(const Image& image) : ImageView(image.width, image.height, image.rgba.data()) {}

  std::size_t bytes() const { return std::size_t{4} * width * height; }
  const std::uint8_t* pixel(std::uint32_t x, std::uint32_t y) const {
    return rgba + 4 * (static_cast<std::size_t>(y) * width + x);
  }
};

/// Takes the image with this number of several. Its pixels last only for the call.
using TakeImage = std::function<void(std::size_t number, const ImageView& image)>;

}  // namespace mesher
