#include "engine/io/image_size.h"

#include <gtest/gtest.h>

#include <string>

#include "engine/core/image.h"
#include "engine/io/png.h"
#include "tests/support/bytes.h"

namespace mesher::io {
namespace {

const std::string kPngHeader("\x89PNG\r\n\x1a\n\0\0\0\rIHDR\0\0\1\2\0\0\0\3", 24);

TEST(ImageSize, ReadsHeaders) {
  EXPECT_EQ(image_size(kPngHeader), glm::uvec2(258, 3));
  const std::string ktx = std::string("\xABKTX 20\xBB\r\n\x1a\n", 12) + std::string(8, '\0') +
                          test::bytes_of<std::uint32_t>({640, 480});
  EXPECT_EQ(image_size(ktx), glm::uvec2(640, 480));
  const std::string dds = "DDS " + test::bytes_of<std::uint32_t>({124, 0, 20, 30});
  EXPECT_EQ(image_size(dds), glm::uvec2(30, 20));
}

TEST(ImageSize, DamagedHeadersHaveNone) {
  for (std::size_t length = 0; length < kPngHeader.size(); ++length)
    EXPECT_FALSE(image_size(kPngHeader.substr(0, length))) << length;
  for (const std::string& bytes :
       {std::string("\xFF\xD8\xFF\xE0"), std::string("RIFF"),
        std::string("RIFF\1\0\0\0WEBPVP8 ", 16), std::string("DDS "), std::string("GIF89a")})
    EXPECT_FALSE(image_size(bytes));
}

}  // namespace
}  // namespace mesher::io
