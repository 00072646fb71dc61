#include "engine/io/png_writer.h"

#include <spng.h>

#include "engine/core/assert.h"
#include "engine/core/error.h"

namespace mesher::io {
namespace {

/// Rendered images are mostly uniform areas. There, the level hardly changes the size but does
/// change the time.
constexpr int kCompressionLevel = 1;
constexpr std::size_t kBufferedBytes = std::size_t{1} << 20;

}  // namespace

void PngWriter::FreeContext::operator()(spng_ctx* context) const {
  spng_ctx_free(context);
}

PngWriter::PngWriter(AtomicFile& file, std::uint32_t width, std::uint32_t height)
    : file_(file), context_(spng_ctx_new(SPNG_CTX_ENCODER)), width_(width), missing_rows_(height) {
  MESHER_ASSERT(width > 0 && height > 0);
  if (!context_) throw OutputError(file.name(), "out of memory");
  spng_ihdr header = {};
  header.width = width;
  header.height = height;
  header.bit_depth = 8;
  header.color_type = SPNG_COLOR_TYPE_TRUECOLOR_ALPHA;
  check(spng_set_png_stream(context_.get(), take_bytes, this));
  check(spng_set_option(context_.get(), SPNG_IMG_COMPRESSION_LEVEL, kCompressionLevel));
  check(spng_set_option(context_.get(), SPNG_FILTER_CHOICE, SPNG_FILTER_CHOICE_SUB));
  check(spng_set_ihdr(context_.get(), &header));
  check(spng_encode_image(context_.get(), nullptr, 0, SPNG_FMT_PNG,
                          SPNG_ENCODE_PROGRESSIVE | SPNG_ENCODE_FINALIZE));
}

PngWriter::~PngWriter() = default;

void PngWriter::append(const Image& rows, const Progress* progress) {
  MESHER_ASSERT(rows.width == width_ && rows.height <= missing_rows_);
  MESHER_ASSERT(rows.rgba.size() == std::size_t{4} * rows.width * rows.height);
  for (std::uint32_t y = 0; y < rows.height; ++y, --missing_rows_) {
    check_cancelled(progress);
    const int error = spng_encode_row(context_.get(), rows.pixel(0, y), std::size_t{4} * width_);
    if (error != SPNG_EOI || missing_rows_ > 1) check(error);
  }
}

void PngWriter::finish() {
  MESHER_ASSERT(missing_rows_ == 0);
  flush();
}

int PngWriter::take_bytes(spng_ctx* /*context*/, void* writer, void* bytes, std::size_t size) {
  PngWriter& self = *static_cast<PngWriter*>(writer);
  try {
    self.bytes_.append(static_cast<const char*>(bytes), size);
    if (self.bytes_.size() >= kBufferedBytes) self.flush();
    return 0;
  } catch (...) {
    self.failure_ = std::current_exception();
    return SPNG_IO_ERROR;
  }
}

void PngWriter::check(int error) {
  if (failure_) std::rethrow_exception(failure_);
  if (error != 0) throw OutputError(file_.name(), spng_strerror(error));
}

void PngWriter::flush() {
  file_.write(bytes_);
  bytes_.clear();
}

}  // namespace mesher::io
