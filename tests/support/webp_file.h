#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

#include "engine/core/image.h"

namespace mesher::test {

struct WebpFile {
  std::vector<Image> frames;           ///< as shown, each with the size of the animation
  std::vector<std::uint32_t> ends_ms;  ///< when each frame ends
  std::uint32_t loops = 0;             ///< 0: forever
};

/// Reads a still or animated WebP. Without frames: the file is missing or damaged.
WebpFile read_webp(const std::filesystem::path& file);

}  // namespace mesher::test
