#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string_view>

#include "engine/core/image.h"
#include "engine/io/atomic_file.h"

namespace mesher::io {

/// Writes an image as 8-bit RGBA PNG (PngWriter) that appears whole or not at all. Throws
/// OutputError. Pre: width and height are at least 1.
void write_png(const std::filesystem::path& file, const Image& image, Flush flush = Flush::later);

/// Reads any PNG as 8-bit RGBA. Throws InputError if the file is damaged, is not a PNG, or is wider
/// or higher than 32,768 pixels.
Image read_png(const std::filesystem::path& file);

/// Decodes a PNG of any kind as 8-bit RGBA, into memory of exactly its size. Returns false if the
/// PNG is damaged or of another size.
bool decode_png(std::string_view bytes, std::span<std::uint8_t> rgba);

}  // namespace mesher::io
