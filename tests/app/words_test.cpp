#include "app/words.h"

#include <gtest/gtest.h>

namespace mesher::app {
namespace {

TEST(Words, LongNumbersGetCommas) {
  EXPECT_EQ(with_commas(0), "0");
  EXPECT_EQ(with_commas(999), "999");
  EXPECT_EQ(with_commas(1000), "1,000");
  EXPECT_EQ(with_commas(123456), "123,456");
  EXPECT_EQ(with_commas(1234567), "1,234,567");
}

TEST(Words, ShortNumbersHaveSixDigits) {
  EXPECT_EQ(short_number(0.001234567891), "0.00123457");
  EXPECT_EQ(short_number(2.0), "2");
}

}  // namespace
}  // namespace mesher::app
