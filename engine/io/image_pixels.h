#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <string_view>

#include "engine/io/image_header.h"

namespace mesher::io {

/// Returns how often a decoder can halve an image at most, at no cost: JPEG has its pixels as waves
/// over blocks of 8 x 8, and can leave out the short ones.
std::uint32_t most_halvings(ImageCoding coding);

/// Decodes an image as 8-bit RGBA into memory of exactly its size, halved so often. Returns false
/// if it is damaged, or not of the size that its header says. `header`: as read from `bytes`. Pre:
/// `halved` is at most most_halvings(), and divides both sides.
///
/// It calls the libraries, which a file may crash or keep busy for long, so call it in a child
/// process. O(bytes + pixels).
bool decode_pixels(const ImageHeader& header, std::string_view bytes, std::uint32_t halved,
                   std::span<std::uint8_t> rgba);

using DecodePixels = std::function<decltype(decode_pixels)>;

}  // namespace mesher::io
