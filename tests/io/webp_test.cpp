#include "engine/io/webp.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "engine/core/error.h"
#include "tests/support/temp_folder.h"
#include "tests/support/webp_file.h"

namespace mesher {
namespace {

using test::read_webp;
using test::TempFolder;

/// A ramp, with partly transparent pixels.
Image ramp(std::uint32_t width, std::uint32_t height, std::uint32_t shift = 0) {
  Image image{.width = width, .height = height, .rgba = {}};
  for (std::uint32_t y = 0; y < height; ++y) {
    for (std::uint32_t x = 0; x < width; ++x) {
      for (const std::uint32_t value : {2 * x + shift, 3 * y, x + y + shift, 255 - x})
        image.rgba.push_back(static_cast<std::uint8_t>(value));
    }
  }
  return image;
}

/// A dark square on a light, opaque ground.
Image square_at(std::uint32_t left) {
  Image image{.width = 64, .height = 48, .rgba = {}};
  for (std::uint32_t y = 0; y < image.height; ++y) {
    for (std::uint32_t x = 0; x < image.width; ++x) {
      const bool is_inside = x >= left && x < left + 16 && y >= 16 && y < 32;
      const std::uint8_t value = is_inside ? 40 : 240;
      image.rgba.insert(image.rgba.end(), {value, value, value, 255});
    }
  }
  return image;
}

TEST(Webp, StillKeepsEveryPixel) {
  const TempFolder folder;
  for (const auto& [width, height] : {std::pair{1U, 1U}, {3U, 5U}, {120U, 70U}}) {
    const Image image = ramp(width, height);
    io::write_webp(folder / "a.webp", image);
    const test::WebpFile back = read_webp(folder / "a.webp");
    ASSERT_EQ(back.frames.size(), 1U);
    EXPECT_EQ(back.frames[0].width, width);
    EXPECT_EQ(back.frames[0].height, height);
    EXPECT_EQ(back.frames[0].rgba, image.rgba);
  }
  EXPECT_EQ(folder.count_files(), 1U);
}

TEST(Webp, FailedStillLeavesNoFile) {
  const TempFolder folder;
  EXPECT_THROW(io::write_webp(folder / "missing/a.webp", ramp(2, 2)), OutputError);
  EXPECT_THROW(io::write_webp("/dev/full", ramp(2, 2)), OutputError);
  EXPECT_EQ(folder.count_files(), 0U);
}

TEST(Webp, RefusesSizesThatTheFormatLacks) {
  const TempFolder folder;
  EXPECT_NO_THROW(io::write_webp(folder / "a.webp", ramp(io::kMostWebpSide, 1)));
  std::filesystem::remove(folder / "a.webp");
  EXPECT_THROW(io::write_webp(folder / "a.webp", ramp(io::kMostWebpSide + 1, 1)), OutputError);
  EXPECT_THROW(io::write_webp(folder / "a.webp", ramp(1, 0)), OutputError);
  EXPECT_THROW(io::WebpAnimation(folder / "a.webp", 1, io::kMostWebpSide + 1), OutputError);
  EXPECT_EQ(folder.count_files(), 0U);
}

TEST(Webp, CancelledStillLeavesNoFile) {
  const TempFolder folder;
  Progress progress;
  progress.cancel();
  EXPECT_THROW(io::write_webp(folder / "a.webp", ramp(64, 64), &progress), Cancelled);
  EXPECT_EQ(folder.count_files(), 0U);
}

TEST(WebpAnimation, KeepsFramesAndTimesAndRepeatsForever) {
  const TempFolder folder;
  io::WebpAnimation animation(folder / "a.webp", 64, 48);
  const std::vector<std::uint32_t> begins{0, 40, 125};
  for (std::uint32_t i = 0; i < begins.size(); ++i)
    animation.append(square_at(16 * i), begins[i]);
  EXPECT_EQ(folder.count_files(), 0U) << "nothing appears before it is whole";
  animation.finish(200);
  const test::WebpFile back = read_webp(folder / "a.webp");
  EXPECT_EQ(back.loops, 0U);
  EXPECT_EQ(back.ends_ms, (std::vector<std::uint32_t>{40, 125, 200}));
  ASSERT_EQ(back.frames.size(), 3U);
  for (std::uint32_t i = 0; i < 3; ++i) {
    const Image drawn = square_at(16 * i);
    double sum = 0.0;
    for (std::size_t k = 0; k < drawn.rgba.size(); ++k)
      sum += std::abs(int{drawn.rgba[k]} - int{back.frames[i].rgba[k]});
    EXPECT_LT(sum / static_cast<double>(drawn.rgba.size()), 2.0);
  }
}

TEST(WebpAnimation, FramesKeepNothingOfTheFramesBefore) {
  const TempFolder folder;
  const auto last_frame = [&](std::uint32_t first) {
    constexpr std::uint32_t kLast = 8;
    io::WebpAnimation animation(folder / "a.webp", 64, 48);
    for (std::uint32_t i = first; i <= kLast; ++i) {
      Image frame = square_at(2 * i);
      for (std::size_t k = 0; k < frame.rgba.size(); k += 4)
        frame.rgba[k] = static_cast<std::uint8_t>(frame.rgba[k] - k / 4 % 64 / 2 + i);
      animation.append(frame, 50 * i);
    }
    animation.finish(50 * (kLast + 1));
    return read_webp(folder / "a.webp").frames.back();
  };
  EXPECT_EQ(last_frame(0).rgba, last_frame(8).rgba);
}

TEST(WebpAnimation, KeepsTransparency) {
  const TempFolder folder;
  io::WebpAnimation animation(folder / "a.webp", 64, 48);
  for (std::uint32_t i = 0; i < 3; ++i) {
    Image frame = square_at(16 * i);
    for (std::size_t k = 0; k < frame.rgba.size(); k += 4) {
      if (frame.rgba[k] == 240) std::fill_n(frame.rgba.begin() + k, 4, std::uint8_t{0});
    }
    animation.append(frame, 50 * i);
  }
  animation.finish(150);
  const test::WebpFile back = read_webp(folder / "a.webp");
  ASSERT_EQ(back.frames.size(), 3U);
  for (std::uint32_t i = 0; i < 3; ++i) {
    for (std::uint32_t x = 0; x < 64; ++x) {
      const bool is_inside = x >= 16 * i && x < 16 * i + 16;
      EXPECT_EQ(back.frames[i].pixel(x, 24)[3], is_inside ? 255 : 0) << i << ", " << x;
    }
  }
}

TEST(WebpAnimation, UnfinishedLeavesNoFile) {
  const TempFolder folder;
  {
    io::WebpAnimation animation(folder / "a.webp", 64, 48);
    animation.append(square_at(0), 0);
  }
  EXPECT_EQ(folder.count_files(), 0U);
  EXPECT_THROW(io::WebpAnimation(folder / "missing/a.webp", 64, 48), OutputError);
  io::WebpAnimation animation("/dev/full", 64, 48);
  animation.append(square_at(0), 0);
  EXPECT_THROW(animation.finish(50), OutputError);
}

TEST(WebpAnimation, RefusesFrameOfAnotherSize) {
  const TempFolder folder;
  io::WebpAnimation animation(folder / "a.webp", 64, 48);
  EXPECT_THROW(animation.append(ramp(32, 48), 0), OutputError);
}

}  // namespace
}  // namespace mesher
