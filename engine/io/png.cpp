#include "engine/io/png.h"

#include <spng.h>

#include <cstdlib>
#include <memory>
#include <string_view>

#include "engine/core/assert.h"
#include "engine/core/error.h"
#include "engine/io/atomic_file.h"
#include "engine/io/mapped_file.h"

namespace mesher::io {
namespace {

constexpr std::uint32_t kLargestSide = 32768;
/// Rendered images are mostly uniform areas. There, the level hardly changes the size but does
/// change the time.
constexpr int kCompressionLevel = 1;

struct FreeContext {
  void operator()(spng_ctx* context) const { spng_ctx_free(context); }
};
using Context = std::unique_ptr<spng_ctx, FreeContext>;

struct FreeBuffer {
  void operator()(void* buffer) const { std::free(buffer); }
};

}  // namespace

void write_png(const std::filesystem::path& file, const Image& image) {
  MESHER_ASSERT(image.width > 0 && image.height > 0);
  MESHER_ASSERT(image.rgba.size() == std::size_t{4} * image.width * image.height);
  AtomicFile out(file);
  const Context context(spng_ctx_new(SPNG_CTX_ENCODER));
  const auto check = [&](int error) {
    if (error != 0) throw OutputError(file.string(), spng_strerror(error));
  };
  if (!context) throw OutputError(file.string(), "out of memory");
  spng_ihdr header = {};
  header.width = image.width;
  header.height = image.height;
  header.bit_depth = 8;
  header.color_type = SPNG_COLOR_TYPE_TRUECOLOR_ALPHA;
  check(spng_set_option(context.get(), SPNG_ENCODE_TO_BUFFER, 1));
  check(spng_set_option(context.get(), SPNG_IMG_COMPRESSION_LEVEL, kCompressionLevel));
  check(spng_set_option(context.get(), SPNG_FILTER_CHOICE, SPNG_FILTER_CHOICE_SUB));
  check(spng_set_ihdr(context.get(), &header));
  check(spng_encode_image(context.get(), image.rgba.data(), image.rgba.size(), SPNG_FMT_PNG,
                          SPNG_ENCODE_FINALIZE));
  std::size_t size = 0;
  int error = 0;
  const std::unique_ptr<void, FreeBuffer> bytes(spng_get_png_buffer(context.get(), &size, &error));
  check(error);
  out.write({static_cast<const char*>(bytes.get()), size});
  out.commit();
}

Image read_png(const std::filesystem::path& file) {
  const MappedFile bytes(file);
  const Context context(spng_ctx_new(0));
  const auto check = [&](int error) {
    if (error != 0) throw InputError(bytes.name(), 0, spng_strerror(error));
  };
  if (!context) throw InputError(bytes.name(), 0, "out of memory");
  check(spng_set_image_limits(context.get(), kLargestSide, kLargestSide));
  check(spng_set_png_buffer(context.get(), bytes.begin(), bytes.size()));
  spng_ihdr header = {};
  check(spng_get_ihdr(context.get(), &header));
  std::size_t size = 0;
  check(spng_decoded_image_size(context.get(), SPNG_FMT_RGBA8, &size));
  // Deflate shrinks data at most about a thousandfold, and RGBA has four times the bytes of 8-bit
  // gray. A file that claims more is truncated, hostile, or a nearly blank image of fewer than 8
  // bits per sample.
  if (size / 4096 > bytes.size())
    throw InputError(bytes.name(), 0, "too few bytes for its dimensions");
  Image image{.width = header.width, .height = header.height, .rgba = Array<std::uint8_t>(size)};
  check(
      spng_decode_image(context.get(), image.rgba.data(), size, SPNG_FMT_RGBA8, SPNG_DECODE_TRNS));
  return image;
}

}  // namespace mesher::io
