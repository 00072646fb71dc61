#include "engine/io/image_header.h"

#include <gtest/gtest.h>

#include <string>

#include "tests/support/bytes.h"

namespace mesher::io {
namespace {

using namespace std::string_literals;

void expect_header(const std::string& bytes, ImageCoding coding, std::uint32_t width,
                   std::uint32_t height) {
  const ImageHeader header = read_image_header(bytes);
  EXPECT_EQ(header.coding, coding);
  EXPECT_EQ(header.width, width);
  EXPECT_EQ(header.height, height);
}

const std::string kSmallPng = "\x89PNG\r\n\x1a\n\0\0\0\x0dIHDR\0\1\x02\x03\0\0\0\x07"s;
const std::string kFrame = "\xff\xc2\0\x0b\x08\x01\x02\x03\x04\1\1\x11\0"s;  // 772 x 258
const std::string kJpeg = "\xff\xd8\xff\xe0\0\x04\xff\xc0"s + kFrame;

TEST(ImageHeader, ReadsTheSizeOfEveryKind) {
  expect_header(kSmallPng, ImageCoding::png, 0x10203, 7);
  expect_header(kJpeg, ImageCoding::jpeg, 0x304, 0x102);
  expect_header("RIFF....WEBPVP8X....\0...\xff\x01\0\x02\0\0"s, ImageCoding::webp, 512, 3);
  expect_header("RIFF....WEBPVP8L....\x2f\xff\xc3\x1f\0"s, ImageCoding::webp, 1024, 128);
  expect_header("RIFF....WEBPVP8 .......\x9d\x01\x2a\x10\x40\x20\x80"s, ImageCoding::webp, 16, 32);
}

TEST(ImageHeader, FillAndTablesBeforeTheFrameOfAJpegAreSkipped) {
  expect_header("\xff\xd8\xff\xff\xff\xc4\0\x03.\x01"s + kFrame, ImageCoding::jpeg, 0x304, 0x102);
}

TEST(ImageHeader, DamagedOnesHaveNoSize) {
  for (std::size_t size = 8; size < kSmallPng.size() - 4; ++size)
    EXPECT_EQ(read_image_header(kSmallPng.substr(0, size)).height, 0U) << size;
  for (std::size_t size = 3; size < 15; ++size)
    EXPECT_EQ(read_image_header(kJpeg.substr(0, size)).width, 0U) << size;
  expect_header("\xff\xd8\xff\xda\0\x02\xff\xd9....."s, ImageCoding::jpeg, 0, 0);
  expect_header("RIFF....WEBPALPH........................"s, ImageCoding::webp, 0, 0);
  for (const char* kind : {"VP8 ", "VP8L", "VP8X"})
    expect_header("RIFF....WEBP"s + kind + "....\x2f..."s, ImageCoding::webp, 0, 0);
}

TEST(ImageHeader, OtherBytesAreUnknown) {
  for (const char* bytes : {"", "GIF89a", "RIFF....WAVEfmt ", "\xabKTX 20\xbb", "\xff\xd8"})
    expect_header(bytes, ImageCoding::unknown, 0, 0);
}

TEST(ImageHeader, KnowsTheSizeOfImagesWithoutADecoder) {
  const std::string ktx = "\xABKTX 20\xBB\r\n\x1a\n"s + std::string(8, '\0') +
                          test::bytes_of<std::uint32_t>({640, 480});
  expect_header(ktx, ImageCoding::unknown, 640, 480);
  const std::string dds = "DDS " + test::bytes_of<std::uint32_t>({124, 0, 20, 30});
  expect_header(dds, ImageCoding::unknown, 30, 20);
  EXPECT_EQ(read_image_header(ktx.substr(0, 27)).width, 0U);
  EXPECT_EQ(read_image_header("DDS ").width, 0U);
}

}  // namespace
}  // namespace mesher::io
