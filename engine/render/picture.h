#pragma once

#include <cstdint>
#include <functional>

#include "engine/core/image.h"
#include "engine/core/progress.h"
#include "engine/render/renderer.h"

namespace mesher::render {

inline constexpr unsigned kMostScale = 8;
inline constexpr unsigned kMostSupersample = 3;
/// The largest side of a picture, in pixels: enough for a 4K window 8 times.
inline constexpr std::uint32_t kMostPictureSide = 32'768;
/// The largest side of a picture in pixels that are drawn, which is `supersample` times its own.
inline constexpr std::uint32_t kMostDrawnSide = 65'535;

/// Limits of the images that a picture is drawn into, beside those of the device.
struct TileLimits {
  std::uint32_t side = 4096;
  /// 4096 x 2048: at 4 samples, 300 MB of GPU memory. A 4K window is one tile.
  std::uint32_t pixels = std::uint32_t{1} << 23;
  std::uint32_t viewport = 0xFFFFFFFFU;  ///< as PicturePart::largest_viewport
};

struct PictureOptions {
  VkExtent2D window{800, 600};  ///< the size that the picture shows, in pixels
  unsigned scale = 1;           ///< pixels of the picture per pixel of the window, 1 to 8
  /// Squared, the number of pixels that are drawn for each pixel of the picture, 1 to 3. Their
  /// average is taken in linear light, like the renderer's own resolve of its samples.
  unsigned supersample = 1;
  /// No background: straight alpha, 0 where nothing is drawn.
  bool is_transparent = false;
  TileLimits tiles;
  Progress* progress = nullptr;
};

/// Returns width and height of the picture. Pre: scale and supersample are in range.
VkExtent2D picture_size(const PictureOptions& options);

/// Takes the next rows of a picture, from the top: an image of its full width.
using TakeRows = std::function<void(const Image& rows)>;

/// Draws a picture in tiles and passes it on in bands of rows, so that its memory is that of one
/// band. A picture within the limits is one tile, and equals that of render_image byte for byte.
///
/// Pre: `mesh` has been applied with `settings`; the options are in range, and the size of the
/// picture is from 1 to kMostPictureSide and kMostDrawnSide. Throws DeviceError, or Cancelled.
void draw_picture(gpu::Device& device, Renderer& renderer, const GpuMesh& mesh,
                  const Camera& camera, const Settings& settings, const PictureOptions& options,
                  const TakeRows& take);

/// As above, but returns the whole picture.
Image draw_picture(gpu::Device& device, Renderer& renderer, const GpuMesh& mesh,
                   const Camera& camera, const Settings& settings, const PictureOptions& options);

}  // namespace mesher::render
