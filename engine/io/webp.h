#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>

#include "engine/core/image.h"
#include "engine/core/progress.h"
#include "engine/io/atomic_file.h"

struct WebPAnimEncoder;

namespace mesher::io {

/// The largest side of a WebP image, in pixels.
inline constexpr std::uint32_t kMostWebpSide = 16'383;

/// Writes an image as lossless WebP that appears whole or not at all. Throws OutputError, also for
/// a side that is not from 1 to kMostWebpSide; or Cancelled while it compresses.
void write_webp(const std::filesystem::path& file, const Image& image, Progress* progress = nullptr,
                Flush flush = Flush::later);

/// Writes an animated WebP that repeats forever. Frames are compressed lossily at a quality that
/// keeps thin lines sharp. The animation is in memory, compressed, until `finish` writes it.
class WebpAnimation {
 public:
  /// Throws OutputError if the file cannot be written, or if a side is not from 1 to kMostWebpSide.
  WebpAnimation(const std::filesystem::path& file, std::uint32_t width, std::uint32_t height);
  ~WebpAnimation();
  WebpAnimation(const WebpAnimation&) = delete;
  WebpAnimation& operator=(const WebpAnimation&) = delete;

  /// Appends a frame that is shown from `begin_ms` after the start. Pre: it has the size of the
  /// animation, and begins later than the frame before. Throws OutputError.
  void append(const Image& frame, std::uint32_t begin_ms);
  /// Writes and commits the file. The last frame is shown until `end_ms`, and then the first one
  /// again. Pre: there is a frame. Throws OutputError.
  void finish(std::uint32_t end_ms, Flush flush = Flush::later);

 private:
  struct FreeEncoder {
    void operator()(WebPAnimEncoder* encoder) const;
  };

  [[noreturn]] void fail();

  AtomicFile file_;
  std::unique_ptr<WebPAnimEncoder, FreeEncoder> encoder_;
};

}  // namespace mesher::io
