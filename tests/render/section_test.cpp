#include "engine/render/section.h"

#include <gtest/gtest.h>

#include <cmath>

namespace mesher::render {
namespace {

/// The factor and center that to_section of shaders/view.glsl decodes.
struct Decoded {
  double factor;
  double center;
};
Decoded decoded_x(std::uint32_t code) {
  return {std::ldexp(1.0, static_cast<int>(code & 0xFU)),
          static_cast<double>(static_cast<std::int8_t>(code >> 8 & 0xFFU))};
}
Decoded decoded_y(std::uint32_t code) {
  return {std::ldexp(1.0, static_cast<int>(code >> 4 & 0xFU)),
          static_cast<double>(static_cast<std::int8_t>(code >> 16 & 0xFFU))};
}

TEST(Section, OfAPictureWithinTheLimitIsTheWholeView) {
  const Section whole = section_of({.picture = {300, 200}}, {300, 200}, {4096, 4096});
  EXPECT_EQ(whole.code, 0U);
  EXPECT_EQ(whole.viewport.x, 0.0F);
  EXPECT_EQ(whole.viewport.y, 0.0F);
  EXPECT_EQ(whole.viewport.width, 300.0F);
  EXPECT_EQ(whole.viewport.height, 200.0F);
  const Section tile =
      section_of({.picture = {300, 200}, .corner = {120, 64}}, {60, 64}, {4096, 4096});
  EXPECT_EQ(tile.code, 0U);
  EXPECT_EQ(tile.viewport.x, -120.0F);
  EXPECT_EQ(tile.viewport.y, -64.0F);
  EXPECT_EQ(tile.viewport.width, 300.0F);
}

// Whatever the section, a point of the view has to land at its pixel, inside the clip volume.
TEST(Section, ProjectsEveryPixelOfATileToItsPosition) {
  constexpr std::uint32_t kLargest = 4096;
  constexpr std::uint32_t kTile = 1024;
  for (const VkExtent2D picture : {VkExtent2D{30720, 17280}, {32767, 4097}, {5001, 300}}) {
    for (std::uint32_t top = 0; top < picture.height; top += kTile) {
      for (std::uint32_t left = 0; left < picture.width; left += kTile) {
        const PicturePart part{
            .picture = picture,
            .corner = {static_cast<std::int32_t>(left), static_cast<std::int32_t>(top)}};
        const VkExtent2D size{std::min(kTile, picture.width), std::min(kTile, picture.height)};
        const Section section = section_of(part, size, {kLargest, kLargest});
        ASSERT_LE(section.viewport.width, kLargest);
        ASSERT_GE(section.viewport.x, -2.0F * kLargest);  // the guaranteed bounds of viewports
        ASSERT_LE(section.viewport.x + section.viewport.width, 2.0F * kLargest - 1.0F);
        const auto check = [](double pixel, double corner, double whole, const Decoded& code,
                              double begin, double length) {
          const double view = 2.0 * (corner + pixel) / whole - 1.0;
          const double clip = code.factor * view - code.center;
          EXPECT_LE(std::abs(clip), 1.0 + 1e-9);
          EXPECT_NEAR(begin + 0.5 * length * (clip + 1.0), pixel, 1e-6);
        };
        const std::uint32_t width = std::min(kTile, picture.width - left);
        const std::uint32_t height = std::min(kTile, picture.height - top);
        for (const double share : {0.0, 0.3, 1.0}) {
          check(share * width, left, picture.width, decoded_x(section.code), section.viewport.x,
                section.viewport.width);
          check(share * height, top, picture.height, decoded_y(section.code), section.viewport.y,
                section.viewport.height);
        }
      }
    }
  }
}

}  // namespace
}  // namespace mesher::render
