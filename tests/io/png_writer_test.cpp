#include "engine/io/png_writer.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "engine/core/error.h"
#include "engine/io/png.h"
#include "tests/support/temp_folder.h"

namespace mesher {
namespace {

using test::read_bytes;
using test::TempFolder;

/// Pixels that compress badly, so that several buffers are written.
Image noise(std::uint32_t width, std::uint32_t height) {
  Image image{.width = width, .height = height, .rgba = {}};
  std::uint32_t state = 1;
  for (std::size_t i = 0; i < std::size_t{4} * width * height; ++i) {
    state = 1664525U * state + 1013904223U;
    image.rgba.push_back(static_cast<std::uint8_t>(state >> 24));
  }
  return image;
}

Image rows_of(const Image& image, std::uint32_t first, std::uint32_t count) {
  Image rows{.width = image.width, .height = count, .rgba = {}};
  rows.rgba.assign(image.pixel(0, first),
                   image.pixel(0, first) + std::size_t{4} * image.width * count);
  return rows;
}

TEST(PngWriter, PiecesGiveTheBytesOfTheWholePicture) {
  const TempFolder folder;
  const Image image = noise(700, 500);
  io::write_png(folder / "whole.png", image);
  io::AtomicFile file(folder / "pieces.png");
  io::PngWriter writer(file, image.width, image.height);
  constexpr std::uint32_t kRows = 77;
  for (std::uint32_t y = 0; y < image.height; y += kRows)
    writer.append(rows_of(image, y, std::min(kRows, image.height - y)));
  writer.finish();
  file.commit();
  EXPECT_EQ(io::read_png(folder / "pieces.png").rgba, image.rgba);
  EXPECT_EQ(read_bytes(folder / "pieces.png"), read_bytes(folder / "whole.png"));
}

TEST(PngWriter, UnfinishedPictureLeavesNoFile) {
  const TempFolder folder;
  {
    io::AtomicFile file(folder / "a.png");
    io::PngWriter writer(file, 70, 50);
    writer.append(noise(70, 20));
  }
  EXPECT_EQ(folder.count_files(), 0U);
}

TEST(PngWriter, FailedWriteIsReported) {
  io::AtomicFile file("/dev/full");
  io::PngWriter writer(file, 1000, 800);
  EXPECT_THROW(
      {
        writer.append(noise(1000, 800));
        writer.finish();
      },
      OutputError);
}

}  // namespace
}  // namespace mesher
