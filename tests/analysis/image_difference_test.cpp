#include "engine/analysis/image_difference.h"

#include <gtest/gtest.h>

#include <cmath>

#include "engine/core/parallel.h"

namespace mesher::test {
namespace {

/// A picture of one color, opaque in its left part.
Image picture(std::uint8_t level, std::uint32_t opaque = 40) {
  Image image{.width = 40, .height = 30, .rgba = {}};
  for (std::uint32_t i = 0; i < image.width * image.height; ++i) {
    const bool is_there = i % image.width < opaque;
    for (int c = 0; c < 3; ++c)
      image.rgba.push_back(is_there ? level : 0);
    image.rgba.push_back(is_there ? 255 : 0);
  }
  return image;
}

TEST(ImageDifference, EqualPicturesHaveInfinitePsnr) {
  const analysis::ImageDifference d = analysis::image_difference(picture(90, 20), picture(90, 20));
  EXPECT_TRUE(std::isinf(d.psnr_db()));
  EXPECT_DOUBLE_EQ(d.ssim, 1.0);
  EXPECT_EQ(d.pixels, 20U * 30U);
}

TEST(ImageDifference, PsnrIsThatOfTheForeground) {
  // The error is 10 in each foreground pixel, however much background there is.
  for (const std::uint32_t opaque : {1U, 20U, 40U}) {
    const analysis::ImageDifference d =
        analysis::image_difference(picture(90, opaque), picture(100, opaque));
    EXPECT_DOUBLE_EQ(d.squared_error, 100.0);
    EXPECT_NEAR(d.psnr_db(), 20.0 * std::log10(25.5), 1e-9);
  }
}

TEST(ImageDifference, ForegroundIsThatOfEitherPicture) {
  const analysis::ImageDifference d = analysis::image_difference(picture(0, 10), picture(0, 30));
  EXPECT_EQ(d.pixels, 30U * 30U);
  EXPECT_NEAR(d.squared_error, 128.0 * 128.0 * 2.0 / 3.0, 1e-6);  // black against the background
  EXPECT_LT(d.ssim, 0.9);
}

TEST(ImageDifference, SsimOfConstantPicturesIsThatOfTheirMeans) {
  const double c1 = 6.5025;
  const double expected = (2.0 * 90 * 100 + c1) / (90.0 * 90 + 100.0 * 100 + c1);
  EXPECT_NEAR(analysis::image_difference(picture(90), picture(100)).ssim, expected, 1e-9);
}

TEST(ImageDifference, EmptyPicturesHaveNoPixels) {
  const analysis::ImageDifference d = analysis::image_difference(picture(0, 0), picture(0, 0));
  EXPECT_EQ(d.pixels, 0U);
  EXPECT_TRUE(std::isinf(d.psnr_db()));
}

TEST(ImageDifference, IsTheSameForAnyNumberOfThreads) {
  const auto measure = [](unsigned threads) {
    const ThreadLimit limit(threads);
    return analysis::image_difference(picture(90, 17), picture(97, 23)).ssim;
  };
  EXPECT_EQ(measure(1), measure(3));
}

}  // namespace
}  // namespace mesher::test
