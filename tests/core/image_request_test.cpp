#include "engine/core/image_request.h"

#include <gtest/gtest.h>

namespace mesher {
namespace {

TEST(ImageRequest, HalvesWhileEnoughIsLeft) {
  EXPECT_EQ(halvings(2048, 2048, ImageRequest{}.needed_side), 0U);
  EXPECT_EQ(halvings(2048, 2048, 1025.0F), 0U);
  EXPECT_EQ(halvings(2048, 2048, 1024.0F), 1U);
  EXPECT_EQ(halvings(2048, 512, 200.0F), 1U) << "the shorter side decides";
  EXPECT_EQ(halvings(2048, 2048, 0.0F), 11U) << "a pixel stays";
}

TEST(ImageRequest, LosesNoOddRowOrColumn) {
  EXPECT_EQ(halvings(1000, 1000, 0.0F), 3U);
  EXPECT_EQ(halvings(1024, 6, 0.0F), 1U);
  EXPECT_EQ(halvings(1, 1024, 0.0F), 0U);
}

}  // namespace
}  // namespace mesher
