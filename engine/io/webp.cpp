#include "engine/io/webp.h"

#include <fmt/format.h>
#include <webp/encode.h>
#include <webp/mux.h>

#include "engine/core/assert.h"
#include "engine/core/error.h"

namespace mesher::io {
namespace {

/// Of libwebp's lossless levels, 0 to 9. Higher ones take several times as long and save little.
constexpr int kLosslessLevel = 2;
constexpr float kAnimationQuality = 85.0F;

/// An image in libwebp's form: a copy.
class WebpImage {
 public:
  WebpImage(const Image& image, const std::string& file) {
    MESHER_ASSERT(image.rgba.size() == std::size_t{4} * image.width * image.height);
    if (WebPPictureInit(&picture_) == 0) throw OutputError(file, "unknown version of libwebp");
    picture_.use_argb = 1;
    picture_.width = static_cast<int>(image.width);
    picture_.height = static_cast<int>(image.height);
    if (WebPPictureImportRGBA(&picture_, image.rgba.data(), 4 * picture_.width) == 0) {
      throw OutputError(file, "out of memory");
    }
  }
  ~WebpImage() { WebPPictureFree(&picture_); }
  WebpImage(const WebpImage&) = delete;
  WebpImage& operator=(const WebpImage&) = delete;

  WebPPicture& get() { return picture_; }

 private:
  WebPPicture picture_{};
};

struct ClearWriter {
  WebPMemoryWriter& writer;
  ~ClearWriter() { WebPMemoryWriterClear(&writer); }
};

struct ClearData {
  WebPData& data;
  ~ClearData() { WebPDataClear(&data); }
};

int report_percent(int percent, const WebPPicture* picture) {
  auto* progress = static_cast<Progress*>(picture->user_data);
  progress->set(static_cast<float>(percent) / 100.0F);
  return progress->is_cancelled() ? 0 : 1;
}

std::string_view bytes_of(const std::uint8_t* bytes, std::size_t size) {
  return {reinterpret_cast<const char*>(bytes), size};
}

void check_size(const std::string& file, std::uint32_t width, std::uint32_t height) {
  if (width > 0 && height > 0 && width <= kMostWebpSide && height <= kMostWebpSide) return;
  throw OutputError(file, fmt::format("{} x {} pixels are not a size of WebP, 1 to {} per side",
                                      width, height, kMostWebpSide));
}

}  // namespace

void write_webp(const std::filesystem::path& file, const Image& image, Progress* progress,
                Flush flush) {
  check_size(file.string(), image.width, image.height);
  AtomicFile out(file);
  WebPConfig config;
  if (WebPConfigInit(&config) == 0 || WebPConfigLosslessPreset(&config, kLosslessLevel) == 0) {
    throw OutputError(out.name(), "unknown version of libwebp");
  }
  config.exact = 1;
  config.thread_level = 1;
  WebpImage source(image, out.name());
  WebPMemoryWriter writer;
  WebPMemoryWriterInit(&writer);
  const ClearWriter clear{writer};
  source.get().writer = WebPMemoryWrite;
  source.get().custom_ptr = &writer;
  if (progress != nullptr) {
    source.get().progress_hook = report_percent;
    source.get().user_data = progress;
  }
  if (WebPEncode(&config, &source.get()) == 0) {
    if (source.get().error_code == VP8_ENC_ERROR_USER_ABORT) throw Cancelled();
    throw OutputError(out.name(), source.get().error_code == VP8_ENC_ERROR_OUT_OF_MEMORY
                                      ? "out of memory"
                                      : "cannot be compressed as WebP");
  }
  out.write(bytes_of(writer.mem, writer.size));
  if (progress != nullptr) progress->seal();
  out.commit(flush);
}

void WebpAnimation::FreeEncoder::operator()(WebPAnimEncoder* encoder) const {
  WebPAnimEncoderDelete(encoder);
}

WebpAnimation::WebpAnimation(const std::filesystem::path& file, std::uint32_t width,
                             std::uint32_t height)
    : file_(file) {
  check_size(file_.name(), width, height);
  WebPAnimEncoderOptions options;
  if (WebPAnimEncoderOptionsInit(&options) == 0) fail();
  options.anim_params.loop_count = 0;
  // Only key frames. The difference to the frame before keeps its compression errors, which show as
  // ghosts of the model beside it. Of a turn, nearly all pixels change anyway: the file is no
  // larger.
  options.kmin = 0;
  options.kmax = 1;
  encoder_.reset(WebPAnimEncoderNew(static_cast<int>(width), static_cast<int>(height), &options));
  if (!encoder_) fail();
}

WebpAnimation::~WebpAnimation() = default;

void WebpAnimation::append(const Image& frame, std::uint32_t begin_ms) {
  WebPConfig config;
  if (WebPConfigInit(&config) == 0) fail();
  config.quality = kAnimationQuality;
  // Chroma has half the resolution, which would blur thin colored lines.
  config.use_sharp_yuv = 1;
  config.thread_level = 1;
  WebpImage source(frame, file_.name());
  if (WebPAnimEncoderAdd(encoder_.get(), &source.get(), static_cast<int>(begin_ms), &config) == 0) {
    fail();
  }
}

void WebpAnimation::finish(std::uint32_t end_ms, Flush flush) {
  WebPData data;
  WebPDataInit(&data);
  const ClearData clear{data};
  if (WebPAnimEncoderAdd(encoder_.get(), nullptr, static_cast<int>(end_ms), nullptr) == 0 ||
      WebPAnimEncoderAssemble(encoder_.get(), &data) == 0) {
    fail();
  }
  file_.write(bytes_of(data.bytes, data.size));
  file_.commit(flush);
}

void WebpAnimation::fail() {
  const char* reason = encoder_ ? WebPAnimEncoderGetError(encoder_.get()) : "out of memory";
  throw OutputError(file_.name(), reason);
}

}  // namespace mesher::io
