#include "engine/io/png.h"

#include <gtest/gtest.h>

#include <string>

#include "engine/core/error.h"
#include "tests/support/temp_folder.h"

namespace mesher {
namespace {

using test::read_bytes;
using test::TempFolder;

Image gradient(std::uint32_t width, std::uint32_t height) {
  Image image{.width = width, .height = height, .rgba = {}};
  for (std::uint32_t y = 0; y < height; ++y) {
    for (std::uint32_t x = 0; x < width; ++x) {
      for (const std::uint32_t value : {x, y, x * y, 255 - x}) {
        image.rgba.push_back(static_cast<std::uint8_t>(value));
      }
    }
  }
  return image;
}

TEST(Png, RoundTripsEveryPixel) {
  const TempFolder folder;
  for (const auto& [width, height] : {std::pair{1U, 1U}, {3U, 5U}, {500U, 500U}}) {
    const Image image = gradient(width, height);
    io::write_png(folder / "a.png", image);
    const Image back = io::read_png(folder / "a.png");
    EXPECT_EQ(back.width, width);
    EXPECT_EQ(back.height, height);
    EXPECT_EQ(back.rgba, image.rgba);
  }
  EXPECT_EQ(folder.count_files(), 1U);
}

TEST(Png, RejectsTruncatedImageWithMissingPixels) {
  const TempFolder folder;
  const Image image = gradient(4, 4);
  io::write_png(folder / "a.png", image);
  const std::string bytes = read_bytes(folder / "a.png");
  std::size_t refused = 0;
  for (std::size_t size = 0; size < bytes.size(); ++size) {
    try {
      EXPECT_EQ(io::read_png(folder.write("cut.png", bytes.substr(0, size))).rgba, image.rgba)
          << size;
    } catch (const InputError&) {
      ++refused;
    }
  }
  // Only checksums and the end marker may be missing.
  EXPECT_GE(refused + 20, bytes.size());
}

TEST(Png, RejectsDamagedFiles) {
  const TempFolder folder;
  io::write_png(folder / "a.png", gradient(4, 4));
  std::string bytes = read_bytes(folder / "a.png");
  bytes[bytes.size() / 2] ^= 1;
  EXPECT_THROW(io::read_png(folder.write("b.png", bytes)), InputError);
  EXPECT_THROW(io::read_png(folder.write("c.png", "no picture at all")), InputError);
  EXPECT_THROW(io::read_png(folder / "missing.png"), InputError);
}

TEST(Png, FailedWriteLeavesNoFile) {
  const TempFolder folder;
  EXPECT_THROW(io::write_png(folder / "missing/a.png", gradient(2, 2)), OutputError);
  EXPECT_THROW(io::write_png("/dev/full", gradient(2, 2)), OutputError);
  EXPECT_EQ(folder.count_files(), 0U);
}

}  // namespace
}  // namespace mesher
