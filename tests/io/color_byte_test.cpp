#include "engine/io/color_byte.h"

#include <gtest/gtest.h>

#include <limits>

namespace mesher::io {
namespace {

TEST(ColorByte, RoundsToTheNearestByte) {
  for (int byte = 0; byte < 256; ++byte) {
    EXPECT_EQ(color_byte(static_cast<float>(byte) / 255.0F), byte);
    EXPECT_EQ(color_byte((static_cast<float>(byte) + 0.4F) / 255.0F), byte);
  }
}

TEST(ColorByte, ClampsWhatIsNoColor) {
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  EXPECT_EQ(color_byte(-0.1F), 0);
  EXPECT_EQ(color_byte(1.1F), 255);
  EXPECT_EQ(color_byte(-kInfinity), 0);
  EXPECT_EQ(color_byte(kInfinity), 255);
  EXPECT_EQ(color_byte(std::numeric_limits<float>::quiet_NaN()), 0);
}

}  // namespace
}  // namespace mesher::io
