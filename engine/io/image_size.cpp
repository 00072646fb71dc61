#include "engine/io/image_size.h"

#include <turbojpeg.h>
#include <webp/decode.h>

#include <cstdint>
#include <memory>

#include "engine/io/image_files.h"

namespace mesher::io {
namespace {

std::uint32_t byte_at(std::string_view bytes, std::size_t at) {
  return static_cast<unsigned char>(bytes[at]);
}

/// Returns the number at an offset; `is_big` if its first byte counts most.
std::uint32_t number_at(std::string_view bytes, std::size_t at, bool is_big) {
  std::uint32_t number = 0;
  for (std::size_t i = 0; i < 4; ++i)
    number |= byte_at(bytes, at + i) << 8 * (is_big ? 3 - i : i);
  return number;
}

/// Where a header has width and height.
struct SizeFields {
  std::size_t width;
  std::size_t height;
  bool is_big = false;
};

std::optional<glm::uvec2> size_in_header(std::string_view bytes, const SizeFields& fields) {
  if (bytes.size() < fields.width + 4 || bytes.size() < fields.height + 4) return std::nullopt;
  return glm::uvec2(number_at(bytes, fields.width, fields.is_big),
                    number_at(bytes, fields.height, fields.is_big));
}

std::optional<glm::uvec2> jpeg_size(std::string_view bytes) {
  const std::unique_ptr<void, int (*)(void*)> jpeg(tjInitDecompress(), &tjDestroy);
  int size[2] = {};
  int subsampling = 0;
  int colors = 0;
  const auto* data = reinterpret_cast<const unsigned char*>(bytes.data());
  if (!jpeg ||
      tjDecompressHeader3(jpeg.get(), data, bytes.size(), &size[0], &size[1], &subsampling,
                          &colors) != 0 ||
      size[0] <= 0 || size[1] <= 0) {
    return std::nullopt;
  }
  return glm::uvec2(size[0], size[1]);
}

std::optional<glm::uvec2> webp_size(std::string_view bytes) {
  int size[2] = {};
  const auto* data = reinterpret_cast<const std::uint8_t*>(bytes.data());
  if (WebPGetInfo(data, bytes.size(), &size[0], &size[1]) == 0) return std::nullopt;
  return glm::uvec2(size[0], size[1]);
}

}  // namespace

std::optional<glm::uvec2> image_size(std::string_view bytes) {
  const std::string_view type = image_type(bytes);
  if (type == "image/png")
    return size_in_header(bytes, {.width = 16, .height = 20, .is_big = true});
  if (type == "image/ktx2") return size_in_header(bytes, {.width = 20, .height = 24});
  if (type == "image/vnd-ms.dds") return size_in_header(bytes, {.width = 16, .height = 12});
  if (type == "image/jpeg") return jpeg_size(bytes);
  if (type == "image/webp") return webp_size(bytes);
  return std::nullopt;
}

}  // namespace mesher::io
