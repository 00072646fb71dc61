#include "engine/io/image_decode.h"

#include <fmt/format.h>
#include <turbojpeg.h>
#include <webp/decode.h>

#include <algorithm>
#include <cstring>
#include <optional>

#include "engine/core/error.h"
#include "engine/core/parallel.h"
#include "engine/io/child_process.h"
#include "engine/io/png.h"

namespace mesher::io {
namespace {

enum class Coding { png, jpeg, webp, unknown };

Coding coding_of(std::string_view bytes) {
  if (bytes.starts_with("\x89PNG\r\n\x1a\n")) return Coding::png;
  if (bytes.starts_with("\xff\xd8\xff")) return Coding::jpeg;
  if (bytes.starts_with("RIFF") && bytes.substr(0, 12).ends_with("WEBP")) return Coding::webp;
  return Coding::unknown;
}

const unsigned char* raw(std::string_view bytes) {
  return reinterpret_cast<const unsigned char*>(bytes.data());
}

std::size_t most_pixel_bytes(std::string_view bytes) {
  return kAlwaysImageBytes + kMostImageBytesPerByte * bytes.size();
}

/// Returns room for an image, or nothing if it is larger than the limits.
std::optional<Image> room_for(std::int64_t width, std::int64_t height, std::string_view bytes) {
  if (width < 1 || height < 1 || width > kMostImageSide || height > kMostImageSide) return {};
  const std::size_t size = 4 * static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  if (size > most_pixel_bytes(bytes)) return {};
  return Image{.width = static_cast<std::uint32_t>(width),
               .height = static_cast<std::uint32_t>(height),
               .rgba = Array<std::uint8_t>(size)};
}

struct FreeDecompressor {
  void operator()(void* handle) const { tjDestroy(handle); }
};

std::optional<Image> decode_jpeg(std::string_view bytes) {
  const std::unique_ptr<void, FreeDecompressor> jpeg(tjInitDecompress());
  int width = 0;
  int height = 0;
  int subsampling = 0;
  int colors = 0;
  if (!jpeg || tjDecompressHeader3(jpeg.get(), raw(bytes), bytes.size(), &width, &height,
                                   &subsampling, &colors) != 0) {
    return {};
  }
  std::optional<Image> image = room_for(width, height, bytes);
  if (!image) return {};
  // A scan may be many times as long as its bytes; the library stops after some hundreds.
  const int error = tjDecompress2(jpeg.get(), raw(bytes), bytes.size(), image->rgba.data(), width,
                                  0, height, TJPF_RGBA, TJFLAG_LIMITSCANS);
  // A warning is given for a file that ends early, of which browsers show the beginning.
  if (error != 0 && tjGetErrorCode(jpeg.get()) != TJERR_WARNING) return {};
  return image;
}

std::optional<Image> decode_webp(std::string_view bytes) {
  WebPBitstreamFeatures features;
  if (WebPGetFeatures(raw(bytes), bytes.size(), &features) != VP8_STATUS_OK) return {};
  std::optional<Image> image = room_for(features.width, features.height, bytes);
  if (!image || features.has_animation != 0) return {};
  if (WebPDecodeRGBAInto(raw(bytes), bytes.size(), image->rgba.data(), image->rgba.size(),
                         4 * features.width) == nullptr) {
    return {};
  }
  return image;
}

std::optional<Image> decode_spng(std::string_view bytes) {
  try {
    return decode_png(bytes, "", {.side = kMostImageSide, .always_bytes = kAlwaysImageBytes});
  } catch (const InputError&) {
    return {};
  }
}

/// Writes width, height and pixels.
bool write_webp_pixels(std::string_view bytes, const ChildWriter& write) {
  const std::optional<Image> image = decode_webp(bytes);
  if (!image) return false;
  const std::uint32_t size[2] = {image->width, image->height};
  return write({reinterpret_cast<const char*>(size), sizeof(size)}) &&
         write({reinterpret_cast<const char*>(image->rgba.data()), image->rgba.size()});
}

/// The child decoded hostile data, so its output is checked like a file.
std::optional<Image> read_pixels(std::string_view output) {
  std::uint32_t size[2] = {};
  if (output.size() < sizeof(size)) return {};
  std::memcpy(size, output.data(), sizeof(size));
  output.remove_prefix(sizeof(size));
  if (std::max(size[0], size[1]) > kMostImageSide) return {};
  if (output.empty() || output.size() != std::size_t{4} * size[0] * size[1]) return {};
  Image image{.width = size[0], .height = size[1], .rgba = Array<std::uint8_t>(output.size())};
  std::memcpy(image.rgba.data(), output.data(), output.size());
  return image;
}

std::optional<Image> decode_webp_in_child(std::string_view bytes, Progress* progress) {
  const ChildLimits limits{.memory = 4 * most_pixel_bytes(bytes) + (std::size_t{256} << 20U),
                           .cpu_s = 60,
                           .output = most_pixel_bytes(bytes) + 8};
  const ChildResult result = run_in_child(
      [&](const ChildWriter& write) { return write_webp_pixels(bytes, write); }, limits, progress);
  if (result.outcome != ChildOutcome::done) return {};
  return read_pixels(result.bytes);
}

std::string label_of(const Materials& materials, std::uint32_t index) {
  if (index < materials.images.size()) {
    const EncodedImage& image = materials.images[index];
    if (!image.path.empty()) return image.path.string();
    if (!image.name.empty()) return image.name;
  }
  return fmt::format("image {}", index);
}

DecodedImage decode_one(const Materials& materials, std::uint32_t index, Progress* progress) {
  if (index >= materials.images.size()) return {{}, "there is no such image"};
  const EncodedImage& image = materials.images[index];
  if (!image.bytes) return {{}, "its file is missing or outside the model's folder"};
  return decode_image(*image.bytes, image.mime_type, progress);
}

}  // namespace

DecodedImage decode_image(std::string_view bytes, std::string_view mime_type, Progress* progress) {
  std::optional<Image> image;
  switch (coding_of(bytes)) {
    case Coding::png:
      image = decode_spng(bytes);
      break;
    case Coding::jpeg:
      image = decode_jpeg(bytes);
      break;
    case Coding::webp:
      image = decode_webp_in_child(bytes, progress);
      break;
    case Coding::unknown: {
      const bool is_known = mime_type == "image/png" || mime_type == "image/jpeg" ||
                            mime_type == "image/webp" || mime_type.empty();
      return {{},
              is_known ? "is not PNG, JPEG or WebP" : fmt::format("no decoder for {}", mime_type)};
    }
  }
  if (image) return {std::move(*image), ""};
  return {{}, fmt::format("is damaged, or larger than {0} x {0} pixels", kMostImageSide)};
}

std::vector<Image> decode_images(const Materials& materials, std::span<const std::uint32_t> indices,
                                 std::vector<std::string>& problems, Progress* progress) {
  // Few at a time, so that they exceed the limit of all by little before it is checked.
  constexpr std::size_t kAtOnce = 8;
  std::vector<Image> images(indices.size());
  std::size_t bytes = 0;
  for (std::size_t first = 0; first < images.size(); first += kAtOnce) {
    const auto some = indices.subspan(first, std::min(kAtOnce, images.size() - first));
    std::vector<DecodedImage> decoded(some.size());
    parallel_for(some.size(), 1, [&](IndexRange range) {
      for (std::size_t i = range.begin; i < range.end; ++i)
        decoded[i] = bytes > kMostPixelBytesOfModel ? DecodedImage{{}, "the others take 2 GB"}
                                                    : decode_one(materials, some[i], progress);
    });
    for (std::size_t i = 0; i < some.size(); ++i) {
      bytes += decoded[i].image.rgba.size();
      if (!decoded[i].problem.empty())
        problems.push_back(fmt::format("texture '{}' is drawn white: {}",
                                       label_of(materials, some[i]), decoded[i].problem));
      images[first + i] = std::move(decoded[i].image);
    }
  }
  return images;
}

}  // namespace mesher::io
