#pragma once

#include <filesystem>

#include "engine/core/image.h"

namespace mesher {

/// Writes a picture as 8-bit RGBA PNG, whole or not at all. Meant to be quick rather than small: a
/// cheap filter and light compression. Throws OutputError. Pre: width and height are at least 1.
void write_png(const std::filesystem::path& file, const Image& image);

/// Reads any PNG as 8-bit RGBA. Throws InputError for a file that is damaged, no PNG, or wider or
/// higher than 32,768 pixels.
Image read_png(const std::filesystem::path& file);

}  // namespace mesher
