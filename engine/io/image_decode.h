#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "engine/core/image.h"
#include "engine/core/image_request.h"
#include "engine/core/progress.h"
#include "engine/io/image_pixels.h"
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

/// Decodes images of a model: PNG, JPEG and WebP. `take` gets each one that can be decoded, with
/// its number in `requests`, in the order in which they are finished. `problems` gets a line for
/// each other one, in the order of `requests`: "texture 'wood.ktx2' is drawn white: ...".
///
/// An image of which less is needed may come halved, once or several times, if its decoder can do
/// so (most_halvings).
///
/// The size in the header is checked before memory is taken. The libraries run in child processes
/// (run_in_children), as many as there are threads, which write the pixels into shared memory: a
/// file that crashes one, or that takes more than 60 s of CPU time, is a problem like any other.
///
/// `decode` is another decoder, for tests. Throws DeviceError if the system starts no process;
/// std::bad_alloc; Cancelled; whatever `take` throws.
void decode_images(const Materials& materials, std::span<const ImageRequest> requests,
                   const TakeImage& take, std::vector<std::string>& problems,
                   Progress* progress = nullptr, const DecodePixels& decode = decode_pixels);

}  // namespace mesher::io
