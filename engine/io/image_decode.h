#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "engine/core/image.h"
#include "engine/core/progress.h"
#include "engine/mesh/material.h"

namespace mesher::io {

/// Limits of the images that are decoded.
inline constexpr std::uint32_t kMostImageSide = 16'384;
/// Bytes of pixels that an image may always have, and how many more per byte of its file. Deflate
/// shrinks data at most about a thousandfold, and RGBA has four times the bytes of 8-bit gray.
inline constexpr std::size_t kAlwaysImageBytes = std::size_t{64} << 20U;
inline constexpr std::size_t kMostImageBytesPerByte = 4096;
/// Bytes of pixels of all images of a model together.
inline constexpr std::size_t kMostPixelBytesOfModel = std::size_t{2} << 30U;

/// The pixels of an image, or why there are none.
struct DecodedImage {
  Image image;          ///< empty if there is a problem
  std::string problem;  ///< "is damaged"; empty if there is none
};

/// Decodes PNG, JPEG or WebP, which the bytes tell apart. `mime_type` names what else it may be.
///
/// The size in the header is checked before memory is taken. WebP is decoded in a child process
/// (run_in_child), because libwebp had an error that files exploited (CVE-2023-4863). libspng and
/// libjpeg-turbo have had none for years, though fuzzers run them all day, and a process for each
/// image would take as long as the decoding: five images of 2048 x 2048 pixels took 0.5 s of two
/// cores rather than 0.2 s.
///
/// Throws DeviceError if the system starts no process; Cancelled.
DecodedImage decode_image(std::string_view bytes, std::string_view mime_type,
                          Progress* progress = nullptr);

/// Decodes images of a model, as many at a time as there are threads. Images that cannot be decoded
/// are empty, and `problems` gets a line for each: "texture 'wood.ktx2': ...". Throws as above.
std::vector<Image> decode_images(const Materials& materials, std::span<const std::uint32_t> indices,
                                 std::vector<std::string>& problems, Progress* progress = nullptr);

}  // namespace mesher::io
