#include "engine/io/image_pixels.h"

#include <turbojpeg.h>
#include <webp/decode.h>

#include <memory>

#include "engine/io/png.h"

namespace mesher::io {
namespace {

const unsigned char* raw(std::string_view bytes) {
  return reinterpret_cast<const unsigned char*>(bytes.data());
}

bool is_size(const ImageHeader& header, int width, int height) {
  return static_cast<std::int64_t>(header.width) == width &&
         static_cast<std::int64_t>(header.height) == height;
}

bool decode_jpeg(const ImageHeader& header, std::string_view bytes, std::uint32_t halved,
                 std::span<std::uint8_t> rgba) {
  const std::unique_ptr<void, int (*)(void*)> jpeg(tjInitDecompress(), &tjDestroy);
  int width = 0;
  int height = 0;
  int subsampling = 0;
  int colors = 0;
  if (!jpeg || tjDecompressHeader3(jpeg.get(), raw(bytes), bytes.size(), &width, &height,
                                   &subsampling, &colors) != 0) {
    return false;
  }
  if (!is_size(header, width, height)) return false;
  // A scan may be many times as long as its bytes; the library stops after some hundreds.
  const int error =
      tjDecompress2(jpeg.get(), raw(bytes), bytes.size(), rgba.data(), width >> halved, 0,
                    height >> halved, TJPF_RGBA, TJFLAG_LIMITSCANS);
  // A warning is given for a file that ends early, of which browsers show the beginning.
  return error == 0 || tjGetErrorCode(jpeg.get()) == TJERR_WARNING;
}

bool decode_webp(const ImageHeader& header, std::string_view bytes, std::span<std::uint8_t> rgba) {
  WebPBitstreamFeatures features;
  if (WebPGetFeatures(raw(bytes), bytes.size(), &features) != VP8_STATUS_OK) return false;
  if (!is_size(header, features.width, features.height) || features.has_animation != 0)
    return false;
  return WebPDecodeRGBAInto(raw(bytes), bytes.size(), rgba.data(), rgba.size(),
                            4 * features.width) != nullptr;
}

}  // namespace

std::uint32_t most_halvings(ImageCoding coding) {
  return coding == ImageCoding::jpeg ? 3 : 0;
}

bool decode_pixels(const ImageHeader& header, std::string_view bytes, std::uint32_t halved,
                   std::span<std::uint8_t> rgba) {
  switch (header.coding) {
    case ImageCoding::png:
      return decode_png(bytes, rgba);
    case ImageCoding::jpeg:
      return decode_jpeg(header, bytes, halved, rgba);
    case ImageCoding::webp:
      return decode_webp(header, bytes, rgba);
    case ImageCoding::unknown:
      break;
  }
  return false;
}

}  // namespace mesher::io
