#include "engine/render/mip_levels.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/render/painted_quads.h"

namespace mesher::render {
namespace {

TEST(MipLevels, EndAtOnePixel) {
  for (const auto& [width, height] : {std::pair{1U, 1U}, {8U, 2U}, {5U, 7U}, {1U, 3U}}) {
    const std::vector<Image> levels =
        mip_levels(image_of(width, std::vector<Rgba>(width * height, {9, 8, 7, 6})), true);
    ASSERT_EQ(levels.size(), std::floor(std::log2(std::max(width, height))));
    if (levels.empty()) continue;
    EXPECT_EQ(levels.front().width, std::max(width / 2, 1U));
    for (const Image& level : levels) {
      ASSERT_EQ(level.rgba.size(), std::size_t{4} * level.width * level.height);
      for (std::size_t i = 0; i < level.rgba.size(); ++i)
        EXPECT_EQ(level.rgba[i], 9 - i % 4) << "one color stays that color";
    }
    EXPECT_EQ(levels.back().width, 1U);
    EXPECT_EQ(levels.back().height, 1U);
  }
}

TEST(MipLevels, EveryColorKeepsItsByte) {
  for (std::uint32_t i = 0; i < 256; ++i) {
    const auto byte = static_cast<std::uint8_t>(i);
    const auto levels = mip_levels(image_of(2, {4, {byte, byte, byte, byte}}), true);
    EXPECT_EQ(levels[0].rgba[0], byte);
  }
}

TEST(MipLevels, AverageColorsInLinearLightAndNumbersAsTheyAre) {
  const std::vector<Rgba> pixels{
      {0, 255, 10, 0}, {255, 255, 10, 255}, {0, 255, 20, 0}, {255, 255, 20, 255}};
  const auto colors = mip_levels(image_of(2, pixels), true);
  EXPECT_EQ(colors[0].rgba[0], 188);
  EXPECT_EQ(colors[0].rgba[1], 255);
  EXPECT_EQ(colors[0].rgba[3], 128);
  const auto numbers = mip_levels(image_of(2, pixels), false);
  EXPECT_EQ(numbers[0].rgba[0], 128);
  EXPECT_EQ(numbers[0].rgba[2], 15);
}

}  // namespace
}  // namespace mesher::render
