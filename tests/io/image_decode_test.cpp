#include "engine/io/image_decode.h"

#include <gtest/gtest.h>
#include <turbojpeg.h>

#include <unistd.h>

#include <chrono>
#include <cmath>
#include <csignal>
#include <random>
#include <string>
#include <thread>
#include <vector>

#include "engine/core/error.h"
#include "engine/core/parallel.h"
#include "engine/io/png.h"
#include "engine/io/webp.h"
#include "tests/support/temp_folder.h"

namespace mesher::io {
namespace {

using test::read_bytes;
using test::TempFolder;

Image smooth_image(std::uint32_t width, std::uint32_t height) {
  Image image{.width = width, .height = height, .rgba = {}};
  for (std::uint32_t y = 0; y < height; ++y) {
    for (std::uint32_t x = 0; x < width; ++x) {
      for (const std::uint32_t value : {4 * x, 4 * y, 128U, 255U})
        image.rgba.push_back(static_cast<std::uint8_t>(value));
    }
  }
  return image;
}

std::string png_of(const Image& image) {
  const TempFolder folder;
  write_png(folder / "a.png", image);
  return read_bytes(folder / "a.png");
}

std::string webp_of(const Image& image) {
  const TempFolder folder;
  write_webp(folder / "a.webp", image);
  return read_bytes(folder / "a.webp");
}

std::string jpeg_of(const Image& image) {
  const tjhandle handle = tjInitCompress();
  unsigned char* bytes = nullptr;
  unsigned long size = 0;
  EXPECT_EQ(
      tjCompress2(handle, image.rgba.data(), static_cast<int>(image.width), 0,
                  static_cast<int>(image.height), TJPF_RGBA, &bytes, &size, TJSAMP_444, 95, 0),
      0);
  std::string result(reinterpret_cast<const char*>(bytes), size);
  tjFree(bytes);
  tjDestroy(handle);
  return result;
}

/// The pixels of an image, or why there are none.
struct DecodedImage {
  Image image;
  std::string problem;
};

Image copy_of(const ImageView& view) {
  Image image{.width = view.width, .height = view.height, .rgba = {}};
  image.rgba.assign(view.rgba, view.rgba + view.bytes());
  return image;
}

Materials materials_of(const std::vector<std::string>& all) {
  Materials materials;
  for (const std::string& bytes : all)
    materials.images.push_back({"", "", "", std::make_shared<const std::string>(bytes)});
  return materials;
}

struct DecodedImages {
  std::vector<Image> images;
  std::vector<std::string> problems;
};

DecodedImages decode_all(const Materials& materials, const std::vector<ImageRequest>& requests,
                         const DecodePixels& decode = decode_pixels) {
  DecodedImages decoded{.images = std::vector<Image>(requests.size()), .problems = {}};
  decode_images(
      materials, requests,
      [&](std::size_t i, const ImageView& image) {
        EXPECT_TRUE(decoded.images.at(i).rgba.empty()) << "each only once";
        decoded.images.at(i) = copy_of(image);
      },
      decoded.problems, nullptr, decode);
  return decoded;
}

DecodedImage decode_image(const std::string& bytes, const std::string& mime_type) {
  Materials materials = materials_of({bytes});
  materials.images[0].mime_type = mime_type;
  DecodedImages decoded = decode_all(materials, {{0}});
  constexpr std::string_view kBegin = "texture 'image 0' is drawn white: ";
  std::string problem;
  for (const std::string& line : decoded.problems) {
    EXPECT_TRUE(line.starts_with(kBegin)) << line;
    problem += line.substr(kBegin.size());
  }
  return {std::move(decoded.images[0]), problem};
}

TEST(ImageDecode, PngAndLosslessWebpAreExact) {
  const Image image = smooth_image(37, 21);
  for (const std::string& bytes : {png_of(image), webp_of(image)}) {
    // The bytes tell what it is, whatever the file says.
    const DecodedImage decoded = decode_image(bytes, "image/jpeg");
    EXPECT_EQ(decoded.problem, "");
    EXPECT_EQ(decoded.image.width, 37U);
    EXPECT_EQ(decoded.image.height, 21U);
    EXPECT_EQ(decoded.image.rgba, image.rgba);
  }
}

TEST(ImageDecode, JpegIsNearlyTheSame) {
  const Image image = smooth_image(64, 48);
  const DecodedImage decoded = decode_image(jpeg_of(image), "image/jpeg");
  ASSERT_EQ(decoded.problem, "");
  ASSERT_EQ(decoded.image.rgba.size(), image.rgba.size());
  for (std::size_t i = 0; i < image.rgba.size(); ++i)
    EXPECT_NEAR(decoded.image.rgba[i], image.rgba[i], 8);
}

TEST(ImageDecode, OtherFormatsAreNamed) {
  EXPECT_EQ(decode_image("\xabKTX 20\xbb", "image/ktx2").problem, "no decoder for image/ktx2");
  EXPECT_EQ(decode_image("DDS ", "image/vnd-ms.dds").problem, "no decoder for image/vnd-ms.dds");
  EXPECT_EQ(decode_image("", "image/png").problem, "is not PNG, JPEG or WebP");
  EXPECT_EQ(decode_image("GIF89a", "").problem, "is not PNG, JPEG or WebP");
}

void set_big_endian(std::string& bytes, std::size_t at, std::uint32_t value, std::size_t size) {
  for (std::size_t i = 0; i < size; ++i)
    bytes[at + i] = static_cast<char>(value >> 8 * (size - 1 - i));
}

/// Claims other sides in a JPEG's frame header.
std::string with_jpeg_size(std::string bytes, std::uint32_t width, std::uint32_t height) {
  const std::size_t frame = bytes.find("\xff\xc0");
  set_big_endian(bytes, frame + 5, height, 2);
  set_big_endian(bytes, frame + 7, width, 2);
  return bytes;
}

TEST(ImageDecode, HugeClaimsAreRefused) {
  const Image image = smooth_image(16, 16);
  std::string png = png_of(image);
  set_big_endian(png, 16, 0x7fffffff, 4);
  EXPECT_NE(decode_image(png, "").problem, "");
  const std::string jpeg = jpeg_of(image);
  EXPECT_NE(decode_image(with_jpeg_size(jpeg, 65500, 65500), "").problem, "");
  EXPECT_NE(decode_image(with_jpeg_size(jpeg, 16384, 16384), "").problem, "")
      << "within the sides, but the bytes are far too few";
  EXPECT_NE(decode_image(with_jpeg_size(jpeg, 0, 16), "").problem, "");
  // Extended WebP: the canvas has 24 bits a side.
  std::string webp = "RIFF....WEBPVP8X";
  webp += std::string("\x0a\0\0\0\0\0\0\0", 8) + "\xff\xff\xff\xff\xff\xff";
  EXPECT_NE(decode_image(webp, "").problem, "");
}

TEST(ImageDecode, DamagedFilesNeverCrash) {
  const Image image = smooth_image(24, 24);
  std::mt19937 random(1);
  for (const std::string& whole : {png_of(image), jpeg_of(image), webp_of(image)}) {
    for (int i = 0; i < 60; ++i) {
      std::string bytes = whole;
      if (i % 3 == 0) {
        bytes.resize(random() % bytes.size());
      } else {
        for (int changes = 0; changes < 3; ++changes)
          bytes[12 + random() % (bytes.size() - 12)] = static_cast<char>(random());
      }
      const DecodedImage decoded = decode_image(bytes, "");
      EXPECT_EQ(decoded.problem.empty(), !decoded.image.rgba.empty());
      EXPECT_EQ(decoded.image.rgba.size(),
                std::size_t{4} * decoded.image.width * decoded.image.height);
    }
  }
}

TEST(ImageDecode, ProblemsNameTheirTextures) {
  const auto shared = [](std::string bytes) {
    return std::make_shared<const std::string>(std::move(bytes));
  };
  Materials materials;
  const Image image = smooth_image(8, 8);
  materials.images = {{"wood", "image/png", "", shared(png_of(image))},
                      {"", "image/ktx2", "maps/stone.ktx2", shared("\xabKTX 20\xbb")},
                      {"gone", "", "", nullptr}};
  const auto [images, problems] = decode_all(materials, {{1}, {0}, {2}, {9}});
  EXPECT_TRUE(images[0].rgba.empty());
  EXPECT_EQ(images[1].rgba, image.rgba);
  ASSERT_EQ(problems.size(), 3U);
  EXPECT_EQ(problems[0], "texture 'maps/stone.ktx2' is drawn white: no decoder for image/ktx2");
  EXPECT_EQ(problems[1],
            "texture 'gone' is drawn white: its file is missing or outside the model's folder");
}

/// Dies of images that are 13 pixels wide.
bool decode_or_die(const ImageHeader& header, std::string_view bytes, std::uint32_t halved,
                   std::span<std::uint8_t> rgba) {
  if (header.width == 13) std::raise(SIGSEGV);
  return decode_pixels(header, bytes, halved, rgba);
}

TEST(ImageDecode, CrashOfADecoderTakesNoOtherImageWithIt) {
  const Image good = smooth_image(16, 8);
  const Materials materials =
      materials_of({png_of(good), png_of(smooth_image(13, 8)), png_of(good),
                    png_of(smooth_image(13, 9)), webp_of(good), png_of(good)});
  for (const unsigned threads : {1U, 2U, 8U}) {
    const ThreadLimit limit(threads);
    const auto [images, problems] =
        decode_all(materials, {{0}, {1}, {2}, {3}, {4}, {5}}, decode_or_die);
    for (const std::size_t i : {0U, 2U, 4U, 5U})
      EXPECT_EQ(images[i].rgba, good.rgba) << i;
    EXPECT_TRUE(images[1].rgba.empty() && images[3].rgba.empty());
    ASSERT_EQ(problems.size(), 2U);
    EXPECT_EQ(problems[0],
              "texture 'image 1' is drawn white: it crashes its decoder, or takes too long");
    EXPECT_TRUE(problems[1].starts_with("texture 'image 3'"));
  }
}

TEST(ImageDecode, LessOfAJpegIsItsAverage) {
  const Image image = smooth_image(64, 48);
  const Materials materials = materials_of({jpeg_of(image), png_of(image)});
  for (const std::uint32_t halved : {0U, 1U, 2U, 3U}) {
    const float side = 48.0F / static_cast<float>(1U << halved);
    const DecodedImages decoded = decode_all(materials, {{0, side}, {1, side}});
    const Image& half = decoded.images[0];
    ASSERT_EQ(half.width, 64U >> halved);
    ASSERT_EQ(half.height, 48U >> halved);
    const std::uint32_t shift = (1U << halved) - 1;  // colors are four per pixel
    for (std::uint32_t y = 0; y < half.height; ++y) {
      for (std::uint32_t x = 0; x < half.width; ++x) {
        EXPECT_NEAR(half.pixel(x, y)[0], 4 * (x << halved) + 2 * shift, 8);
        EXPECT_NEAR(half.pixel(x, y)[1], 4 * (y << halved) + 2 * shift, 8);
      }
    }
    EXPECT_EQ(decoded.images[1].rgba, image.rgba) << "PNG comes whole";
  }
}

TEST(ImageDecode, TruncatedFilesAreRefusedOrShownInPart) {
  const Image image = smooth_image(64, 64);
  for (const std::string& whole : {png_of(image), webp_of(image), jpeg_of(image)}) {
    for (const std::size_t size : {whole.size() / 2, std::size_t{31}, std::size_t{12}}) {
      const DecodedImage decoded = decode_image(whole.substr(0, size), "");
      EXPECT_EQ(decoded.problem.empty(), !decoded.image.rgba.empty()) << size;
      EXPECT_TRUE(size >= 32 || !decoded.problem.empty());
    }
  }
}

TEST(ImageDecode, ImagesBeyondTheLimitOfAModelAreRefused) {
  // Each claims 256 MB; nothing is decoded, because the decoder only says so.
  const std::string large = with_jpeg_size(jpeg_of(smooth_image(16, 16)), 8192, 8192) +
                            std::string(std::size_t{1} << 16U, ' ');
  const Materials materials = materials_of(std::vector<std::string>(9, large));
  std::vector<std::string> problems;
  std::vector<ImageRequest> requests;
  for (std::uint32_t i = 0; i < 9; ++i)
    requests.push_back({i});
  std::size_t taken = 0;
  decode_images(
      materials, requests, [&](std::size_t, const ImageView&) { ++taken; }, problems, nullptr,
      [](const ImageHeader&, std::string_view, std::uint32_t, std::span<std::uint8_t>) {
        return true;
      });
  EXPECT_EQ(taken, 8U);
  ASSERT_EQ(problems.size(), 1U);
  EXPECT_EQ(problems[0], "texture 'image 8' is drawn white: the others take 2 GB");
}

TEST(ImageDecode, CancellationEndsIt) {
  const Materials materials = materials_of({png_of(smooth_image(8, 8))});
  Progress progress;
  std::thread canceling([&] {
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
    progress.cancel();
  });
  std::vector<std::string> problems;
  const std::vector<ImageRequest> requests{{0}};
  EXPECT_THROW(
      decode_images(
          materials, requests, [](std::size_t, const ImageView&) {}, problems, &progress,
          [](const ImageHeader&, std::string_view, std::uint32_t, std::span<std::uint8_t>) {
            ::sleep(1000);
            return true;
          }),
      Cancelled);
  canceling.join();
}

}  // namespace
}  // namespace mesher::io
