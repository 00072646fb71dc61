#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "engine/io/beside.h"
#include "engine/mesh/contents.h"
#include "engine/mesh/material.h"

namespace mesher::io {

/// The largest image that is read, and the most that the images of a model have together.
inline constexpr std::uint64_t kMostImageBytes = std::uint64_t{1} << 28;
inline constexpr std::uint64_t kMostBytesOfImages = std::uint64_t{1} << 31;

/// Returns the type of an encoded image by its first bytes: "image/png", "image/jpeg",
/// "image/webp", "image/ktx2", "image/vnd-ms.dds"; otherwise an empty text.
std::string_view image_type(std::string_view bytes);

/// Reads the files of a model's images.
class ImageFiles {
 public:
  /// `contents` gets a warning for each image that cannot be read.
  explicit ImageFiles(FileContents& contents) : contents_(contents) {}

  /// Sets the bytes and the type of an image from its file. `text` names it in warnings.
  void load(EncodedImage& image, const Beside& found, std::string_view text);

 private:
  FileContents& contents_;
  std::uint64_t bytes_ = 0;
};

}  // namespace mesher::io
