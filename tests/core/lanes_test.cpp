#include "engine/core/lanes.h"

#include <gtest/gtest.h>

namespace mesher::test {
namespace {

TEST(Lanes, BitsOfStartWithTheFirstLane) {
  EXPECT_EQ(bits_of(Int4{0, 0, 0, 0}), 0U);
  EXPECT_EQ(bits_of(Int4{-1, 0, 0, 0}), 1U);
  EXPECT_EQ(bits_of(Int4{0, -1, 0, -1}), 10U);
  EXPECT_EQ(bits_of(kAlways), 15U);
  EXPECT_EQ(bits_of(Float4{1, 2, 3, 4} > Float4{} + 2.5F), 12U);
}

}  // namespace
}  // namespace mesher::test
