#include "app/files/legend_image.h"

#include <gtest/gtest.h>

namespace mesher::app {
namespace {

Legend legend_of_creases() {
  render::Settings settings;
  settings.wireframe = true;
  return legend_of(settings, {.crease_edges = 1});
}

TEST(LegendImage, HoldsTextAndLines) {
  const Image image = legend_image(legend_of_creases(), 1.0F, 800, 600);
  ASSERT_EQ(image.width, 216U);
  int dark = 0;
  int yellow = 0;
  for (std::size_t i = 0; i < image.rgba.size(); i += 4) {
    dark += image.rgba[i] < 80 && image.rgba[i + 3] > 200 ? 1 : 0;
    yellow += image.rgba[i] > 200 && image.rgba[i + 2] < 100 ? 1 : 0;
  }
  EXPECT_GT(dark, 100) << "text";
  EXPECT_GT(yellow, 50) << "lines";
}

TEST(LegendImage, GrowsWithThePicture) {
  const Image once = legend_image(legend_of_creases(), 1.0F, 800, 600);
  const Image twice = legend_image(legend_of_creases(), 2.0F, 1600, 1200);
  EXPECT_EQ(twice.width, 2 * once.width);
  EXPECT_EQ(twice.height, 2 * once.height);
}

TEST(LegendImage, IsEmptyWhereItDoesNotFit) {
  EXPECT_EQ(legend_image({}, 1.0F, 800, 600).width, 0U) << "there is nothing to explain";
  EXPECT_EQ(legend_image(legend_of_creases(), 1.0F, 100, 600).width, 0U);
  EXPECT_EQ(legend_image(legend_of_creases(), 1.0F, 800, 20).width, 0U);
  EXPECT_EQ(legend_image(legend_of_creases(), 1.0F, 160, 600).width, 160U) << "it gets narrower";
}

TEST(LegendImage, BlendsOverItsRowsOnly) {
  Image image;
  image.width = image.height = 1;
  image.rgba.assign(4, 255);
  image.rgba[3] = 128;
  for (const std::uint32_t first : {0U, 1U, 2U}) {
    Image rows;
    rows.width = 3;
    rows.height = 1;
    rows.rgba.assign(12, 0);
    blend_over(rows, first, image, {1, 1});
    EXPECT_EQ(rows.pixel(1, 0)[3], first == 1 ? 128 : 0) << first;
    EXPECT_EQ(rows.pixel(1, 0)[0], first == 1 ? 255 : 0) << "straight alpha";
    EXPECT_EQ(rows.pixel(2, 0)[3], 0);
  }
}

}  // namespace
}  // namespace mesher::app
