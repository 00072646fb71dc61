#include "engine/render/pixel_average.h"

#include <gtest/gtest.h>

#include <array>
#include <vector>

namespace mesher::render {
namespace {

using Pixel = std::array<std::uint8_t, 4>;

Image image_of(std::uint32_t width, const std::vector<Pixel>& pixels) {
  Image image{
      .width = width, .height = static_cast<std::uint32_t>(pixels.size()) / width, .rgba = {}};
  for (const Pixel& pixel : pixels)
    image.rgba.insert(image.rgba.end(), pixel.begin(), pixel.end());
  return image;
}

Pixel pixel_of(const Image& image, std::uint32_t x, std::uint32_t y) {
  const std::uint8_t* p = image.pixel(x, y);
  return {p[0], p[1], p[2], p[3]};
}

TEST(PixelAverage, KeepsOpaquePixelsOfOneSample) {
  std::vector<Pixel> pixels;
  for (unsigned i = 0; i < 256; ++i) {
    const auto byte = static_cast<std::uint8_t>(i);
    pixels.push_back({byte, static_cast<std::uint8_t>(255 - i), byte, 255});
  }
  const Image image = image_of(16, pixels);
  EXPECT_EQ(average_pixels(image, 1).rgba, image.rgba);
}

TEST(PixelAverage, IsTakenInLinearLight) {
  const Image image = image_of(2, {{255, 0, 10, 255},
                                   {0, 0, 10, 255},
                                   {255, 0, 10, 255},
                                   {0, 255, 10, 255},
                                   {7, 7, 7, 255},
                                   {7, 7, 7, 255},
                                   {7, 7, 7, 255},
                                   {7, 7, 7, 255}});
  const Image average = average_pixels(image, 2);
  ASSERT_EQ(average.width, 1U);
  ASSERT_EQ(average.height, 2U);
  // Half of the light is 188 in sRGB, and a quarter is 137; the averages of bytes would be 128, 64.
  EXPECT_EQ(pixel_of(average, 0, 0), (Pixel{188, 137, 10, 255}));
  EXPECT_EQ(pixel_of(average, 0, 1), (Pixel{7, 7, 7, 255}));
}

TEST(PixelAverage, HasStraightAlpha) {
  // Half covered by a color of light 1, 0.5 and 0: premultiplied light 0.5, 0.25 and 0.
  const Image half = average_pixels(image_of(1, {{188, 137, 0, 128}}), 1);
  EXPECT_NEAR(pixel_of(half, 0, 0)[0], 255, 1);
  EXPECT_NEAR(pixel_of(half, 0, 0)[1], 188, 1);
  EXPECT_EQ(pixel_of(half, 0, 0)[2], 0);
  EXPECT_EQ(pixel_of(half, 0, 0)[3], 128);
}

TEST(PixelAverage, EmptyPixelsDoNotDarkenTheColor) {
  const Pixel red{200, 30, 20, 255};
  const Pixel empty{0, 0, 0, 0};
  std::vector<Pixel> pixels(9, empty);
  pixels[0] = pixels[4] = pixels[8] = red;
  const Image average = average_pixels(image_of(3, pixels), 3);
  EXPECT_EQ(pixel_of(average, 0, 0), (Pixel{200, 30, 20, 85}));
  const Image nothing = average_pixels(image_of(3, std::vector<Pixel>(9, empty)), 3);
  EXPECT_EQ(pixel_of(nothing, 0, 0), empty);
}

}  // namespace
}  // namespace mesher::render
