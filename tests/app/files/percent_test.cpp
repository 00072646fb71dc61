#include "app/files/percent.h"

#include <gtest/gtest.h>

namespace mesher::app {
namespace {

TEST(Percent, AnyBytesComeBack) {
  std::string bytes;
  for (int i = 1; i < 256; ++i)
    bytes += static_cast<char>(i);
  EXPECT_EQ(percent_decoded(percent_encoded(bytes)), bytes);
  EXPECT_EQ(percent_encoded("/a b%.obj"), "/a%20b%25.obj");
  for (const char c : percent_encoded(bytes))
    EXPECT_TRUE(c > ' ' && c < 0x7F) << int(c);
}

TEST(Percent, IncompleteCodesStay) {
  EXPECT_EQ(percent_decoded("100%"), "100%");
  EXPECT_EQ(percent_decoded("%4"), "%4");
  EXPECT_EQ(percent_decoded("%zz"), "%zz");
}

}  // namespace
}  // namespace mesher::app
