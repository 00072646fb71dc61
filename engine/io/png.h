#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

#include "engine/core/image.h"

namespace mesher::io {

/// Writes an image as 8-bit RGBA PNG (PngWriter) that appears whole or not at all. Throws
/// OutputError. Pre: width and height are at least 1.
void write_png(const std::filesystem::path& file, const Image& image);

/// Reads any PNG as 8-bit RGBA. Throws InputError if the file is damaged, is not a PNG, or is wider
/// or higher than 32,768 pixels.
Image read_png(const std::filesystem::path& file);

/// Limits of the pixels of a PNG.
struct PngLimits {
  std::uint32_t side = 32'768;
  std::size_t always_bytes = 0;  ///< of pixels, however few bytes the file has
};

/// Reads a PNG from memory. `name` is for messages. Throws InputError as above.
Image decode_png(std::string_view bytes, const std::string& name, const PngLimits& limits = {});

}  // namespace mesher::io
