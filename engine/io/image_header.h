#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>

namespace mesher::io {

enum class ImageCoding : std::uint8_t { png, jpeg, webp, unknown };

/// What an encoded image says about itself.
struct ImageHeader {
  ImageCoding coding = ImageCoding::unknown;
  std::uint32_t width = 0;   ///< 0: the header is damaged
  std::uint32_t height = 0;  ///< 0: the header is damaged

  /// Returns the size of the image as 8-bit RGBA, in bytes.
  std::size_t pixel_bytes() const { return std::size_t{4} * width * height; }
};

/// Reads the header of a PNG, JPEG or WebP, which the bytes tell apart, and the size of a KTX2 or
/// DDS image, whose coding is unknown. It uses no library, so that no file can crash it. O(bytes
/// before the frame of a JPEG), otherwise O(1).
ImageHeader read_image_header(std::string_view bytes);

}  // namespace mesher::io
