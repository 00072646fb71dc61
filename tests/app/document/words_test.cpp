#include "app/document/words.h"

#include <gtest/gtest.h>

namespace mesher::app {
namespace {

TEST(Words, LongNumbersHaveCommas) {
  EXPECT_EQ(with_commas(0), "0");
  EXPECT_EQ(with_commas(999), "999");
  EXPECT_EQ(with_commas(1000), "1,000");
  EXPECT_EQ(with_commas(123456), "123,456");
  EXPECT_EQ(with_commas(1234567), "1,234,567");
}

TEST(Words, DistancesAreInPercentOfDiagonal) {
  EXPECT_EQ(percent_text(12.3456), "12.3 %");
  EXPECT_EQ(far_from("the input", 5.25), "far from the input: 5.25 % of the diagonal (RMS)");
  EXPECT_EQ(stop_text(simplify::StopReason::target_reached), "target reached");
  EXPECT_EQ(stop_text(simplify::StopReason::far_from_input),
            "fewer faces would be further than 5 % of the diagonal from the input");
}

TEST(Words, ShortNumbersHaveSixDigits) {
  EXPECT_EQ(short_number(0.001234567891), "0.00123457");
  EXPECT_EQ(short_number(2.0), "2");
}

}  // namespace
}  // namespace mesher::app
