#include "engine/io/png.h"

#include <spng.h>

#include <memory>

#include "engine/core/error.h"
#include "engine/io/atomic_file.h"
#include "engine/io/mapped_file.h"
#include "engine/io/png_writer.h"

namespace mesher::io {
namespace {

struct FreeContext {
  void operator()(spng_ctx* context) const { spng_ctx_free(context); }
};
using Context = std::unique_ptr<spng_ctx, FreeContext>;

}  // namespace

void write_png(const std::filesystem::path& file, const Image& image, Flush flush) {
  AtomicFile out(file);
  PngWriter writer(out, image.width, image.height);
  writer.append(image);
  writer.finish();
  out.commit(flush);
}

Image read_png(const std::filesystem::path& file) {
  constexpr std::uint32_t kMostSide = 32'768;
  const MappedFile bytes(file);
  const Context context(spng_ctx_new(0));
  const auto check = [&](int error) {
    if (error != 0) throw InputError(bytes.name(), 0, spng_strerror(error));
  };
  if (!context) throw InputError(bytes.name(), 0, "out of memory");
  check(spng_set_image_limits(context.get(), kMostSide, kMostSide));
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

bool decode_png(std::string_view bytes, std::span<std::uint8_t> rgba) {
  const Context context(spng_ctx_new(0));
  std::size_t size = 0;
  return context && spng_set_png_buffer(context.get(), bytes.data(), bytes.size()) == 0 &&
         spng_decoded_image_size(context.get(), SPNG_FMT_RGBA8, &size) == 0 &&
         size == rgba.size() &&
         spng_decode_image(context.get(), rgba.data(), size, SPNG_FMT_RGBA8, SPNG_DECODE_TRNS) == 0;
}

}  // namespace mesher::io
