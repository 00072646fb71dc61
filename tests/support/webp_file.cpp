#include "tests/support/webp_file.h"

#include <webp/demux.h>

#include <memory>
#include <string>

#include "tests/support/temp_folder.h"

namespace mesher::test {
namespace {

struct FreeDecoder {
  void operator()(WebPAnimDecoder* decoder) const { WebPAnimDecoderDelete(decoder); }
};

}  // namespace

WebpFile read_webp(const std::filesystem::path& file) {
  if (!std::filesystem::exists(file)) return {};
  const std::string bytes = read_bytes(file);
  const WebPData data{reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()};
  WebPAnimDecoderOptions options;
  if (WebPAnimDecoderOptionsInit(&options) == 0) return {};
  options.color_mode = MODE_RGBA;
  const std::unique_ptr<WebPAnimDecoder, FreeDecoder> decoder(WebPAnimDecoderNew(&data, &options));
  WebPAnimInfo info;
  if (!decoder || WebPAnimDecoderGetInfo(decoder.get(), &info) == 0) return {};
  WebpFile result{.frames = {}, .ends_ms = {}, .loops = info.loop_count};
  while (WebPAnimDecoderHasMoreFrames(decoder.get()) != 0) {
    std::uint8_t* pixels = nullptr;
    int end_ms = 0;
    if (WebPAnimDecoderGetNext(decoder.get(), &pixels, &end_ms) == 0) return {};
    Image image{.width = info.canvas_width, .height = info.canvas_height, .rgba = {}};
    image.rgba.assign(pixels, pixels + std::size_t{4} * image.width * image.height);
    result.frames.push_back(std::move(image));
    result.ends_ms.push_back(static_cast<std::uint32_t>(end_ms));
  }
  return result;
}

}  // namespace mesher::test
