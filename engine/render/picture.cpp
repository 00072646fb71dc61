#include "engine/render/picture.h"

#include <algorithm>
#include <optional>
#include <utility>

#include "engine/core/assert.h"
#include "engine/render/pixel_average.h"

namespace mesher::render {
namespace {

/// Only multiples of this many pixels keep each pixel in the same place of its quad, over which the
/// GPU takes derivatives.
constexpr std::uint32_t kQuad = 2;

/// Returns the side of a tile for a picture of `picture` pixels: all of it, or whole quads.
std::uint32_t side_within(std::uint32_t picture, std::uint32_t most) {
  return picture <= most ? picture : std::max(most / kQuad, 1U) * kQuad;
}

/// Returns the size of the tiles in pixels of the picture. Only the last tile of a row or column
/// may be smaller.
VkExtent2D tile_size(const gpu::Device& device, const PictureOptions& options) {
  const VkPhysicalDeviceLimits& limits = device.properties().limits;
  const VkExtent2D picture = picture_size(options);
  const unsigned n = options.supersample;
  std::uint32_t side = std::min(options.tiles.side, limits.maxImageDimension2D);
  const std::uint32_t viewport = std::min(
      {options.tiles.viewport, limits.maxViewportDimensions[0], limits.maxViewportDimensions[1]});
  if (n * std::max(picture.width, picture.height) > viewport) side = std::min(side, viewport / 4);
  side /= n;
  const std::uint32_t width = side_within(picture.width, side);
  const std::uint32_t rows = options.tiles.pixels / (n * n) / width;
  return {width, side_within(picture.height, std::min(side, rows))};
}

void copy_tile(const Image& tile, Image& band, std::uint32_t x) {
  const std::uint32_t width = std::min(tile.width, band.width - x);
  for (std::uint32_t y = 0; y < band.height; ++y) {
    const std::uint8_t* from = tile.pixel(0, y);
    std::copy(from, from + std::size_t{4} * width,
              band.rgba.data() + 4 * (std::size_t{y} * band.width + x));
  }
}

/// Work of a slice, between two checks for a cancellation. Each slice costs a pass over the whole
/// tile, so small ones would take far longer in total, however the time of a slice is measured.
constexpr std::uint64_t kSliceWork = 1'000'000;

/// Draws a scene in slices, which do not change the picture.
void draw_slices(gpu::Device& device, std::uint64_t work, const Progress* progress,
                 const std::function<void(VkCommandBuffer, const WorkRange&)>& record) {
  for (std::uint64_t begin = 0; begin < work; begin += kSliceWork) {
    check_cancelled(progress);
    device.run_once([&](VkCommandBuffer commands) {
      record(commands, {begin, std::min(work, begin + kSliceWork)});
    });
  }
}

Image read_tile(gpu::Device& device, const SceneTarget& target, bool is_as_drawn, unsigned n) {
  Image drawn = gpu::read_image(device, target.color(), gpu::kTransferSource);
  return is_as_drawn ? std::move(drawn) : average_pixels(drawn, n);
}

}  // namespace

VkExtent2D picture_size(const PictureOptions& options) {
  return {options.scale * options.window.width, options.scale * options.window.height};
}

void draw_picture(gpu::Device& device, Renderer& renderer, const GpuMesh& mesh,
                  const Camera& camera, const Settings& settings, const PictureOptions& options,
                  const TakeRows& take) {
  const VkExtent2D picture = picture_size(options);
  const unsigned n = options.supersample;
  MESHER_ASSERT(options.scale >= 1 && options.scale <= kMostScale);
  MESHER_ASSERT(n >= 1 && n <= kMostSupersample);
  MESHER_ASSERT(std::max(picture.width, picture.height) <= kMostPictureSide);
  MESHER_ASSERT(n * std::max(picture.width, picture.height) <= kMostDrawnSide);
  const VkExtent2D tile = tile_size(device, options);
  const SceneTarget target(device, {n * tile.width, n * tile.height}, settings.samples);
  const std::uint32_t columns = (picture.width + tile.width - 1) / tile.width;
  const std::uint32_t rows = (picture.height + tile.height - 1) / tile.height;
  PicturePart part{.picture = {n * picture.width, n * picture.height},
                   .pixel_ratio = n * options.scale,
                   .is_transparent = options.is_transparent,
                   .largest_viewport = options.tiles.viewport};
  const auto record = [&](VkCommandBuffer commands, const WorkRange& slice) {
    renderer.draw_slice(commands, target, mesh, camera, settings, slice, part);
  };
  const std::uint64_t work = Renderer::work(mesh, settings);
  for (std::uint32_t row = 0; row < rows; ++row) {
    const std::uint32_t top = row * tile.height;
    Image band{
        .width = picture.width, .height = std::min(tile.height, picture.height - top), .rgba = {}};
    for (std::uint32_t column = 0; column < columns; ++column) {
      report(options.progress,
             static_cast<float>(row * columns + column) / static_cast<float>(rows * columns));
      const std::uint32_t left = column * tile.width;
      part.corner = {static_cast<std::int32_t>(n * left), static_cast<std::int32_t>(n * top)};
      draw_slices(device, work, options.progress, record);
      Image drawn = read_tile(device, target, n == 1 && !options.is_transparent, n);
      if (columns == 1 && drawn.height == band.height) {
        band = std::move(drawn);
        break;
      }
      band.rgba.resize(std::size_t{4} * band.width * band.height);
      copy_tile(drawn, band, left);
    }
    take(band);
  }
  report(options.progress, 1.0F);
}

Image draw_picture(gpu::Device& device, Renderer& renderer, const GpuMesh& mesh,
                   const Camera& camera, const Settings& settings, const PictureOptions& options) {
  const VkExtent2D size = picture_size(options);
  Image picture{.width = size.width, .height = size.height, .rgba = {}};
  draw_picture(device, renderer, mesh, camera, settings, options, [&](const Image& rows) {
    if (rows.height == picture.height) {
      picture.rgba = rows.rgba;
    } else {
      picture.rgba.insert(picture.rgba.end(), rows.rgba.begin(), rows.rgba.end());
    }
  });
  return picture;
}

}  // namespace mesher::render
