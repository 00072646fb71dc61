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

/// Reads a PNG from memory. `name` is for messages. Throws InputError as above, with another limit
/// for a side.
Image decode_png(std::string_view bytes, const std::string& name, std::uint32_t largest_side);

}  // namespace mesher::io
