#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <string_view>

#include "engine/io/image_header.h"

namespace mesher::io {

/// Decodes an image as 8-bit RGBA into memory of exactly its size. Returns false if it is damaged,
/// or not of the size that its header says. `header`: as read from `bytes`.
///
/// It calls the libraries, which a file may crash or keep busy for long, so call it in a child
/// process. O(bytes + pixels).
bool decode_pixels(const ImageHeader& header, std::string_view bytes, std::span<std::uint8_t> rgba);

using DecodePixels = std::function<decltype(decode_pixels)>;

}  // namespace mesher::io
