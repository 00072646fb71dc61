#include "app/ui/code_points.h"

#include <gtest/gtest.h>

#include <string>

namespace mesher::app {
namespace {

CodePoints code_points_of(std::string_view text) {
  CodePoints set;
  set.add_text(text);
  return set;
}

TEST(CodePoints, LatinIsInTheFontAlready) {
  EXPECT_TRUE(code_points_of("bunny_70k (2).obj").is_empty());
  EXPECT_TRUE(code_points_of("h\u00e9ron \u00a9 \u00ff").is_empty());
}

TEST(CodePoints, TextsAreDecoded) {
  const CodePoints set = code_points_of("a\u0436\u5154\u5154\ud1a0.obj");
  EXPECT_EQ(set.count(), 3U);
  EXPECT_TRUE(set.has(0x436));
  EXPECT_TRUE(set.has(0x5154));
  EXPECT_TRUE(set.has(0xD1A0));
  EXPECT_TRUE(code_points_of("\uffff").has(0xFFFF));
  EXPECT_TRUE(code_points_of("\u0100").has(0x100));
}

TEST(CodePoints, InvalidBytesAndOtherPlanesCountAsReplacement) {
  for (const std::string_view text :
       {"\xff", "\x80", "a\xC0\x80", "\xC3", "\xE5\x85", "\xE5\x85q", "\xED\xA0\x80",
        "\xE0\x80\x80", "\xF0\x80\x80\x80", "\xF4\x90\x80\x80", "\xF8\x88\x80\x80\x80",
        "\xF0\x9F\x90\xB0"}) {
    const CodePoints set = code_points_of(text);
    EXPECT_EQ(set.count(), 1U) << testing::PrintToString(text);
    EXPECT_TRUE(set.has(CodePoints::kReplacement)) << testing::PrintToString(text);
  }
  EXPECT_TRUE(code_points_of("\xff\u5154").has(0x5154)) << "decoding continues after an error";
  EXPECT_TRUE(code_points_of("\xE5\x85\u0436").has(0x436));
}

TEST(CodePoints, RangesJoinNeighbors) {
  CodePoints set;
  EXPECT_TRUE(set.ranges().empty());
  for (const char32_t c : {0x436, 0x434, 0x435, 0x5154, 0xFFFF, 0xFFFE, 0x10000})
    set.add(c);
  const std::vector<CodeRange> expected{{0x434, 0x436}, {0x5154, 0x5154}, {0xFFFE, 0xFFFF}};
  EXPECT_EQ(set.ranges(), expected);
}

TEST(CodePoints, SetsAreCombined) {
  CodePoints set = code_points_of("\u0434\u0435\u0436");
  const CodePoints other = code_points_of("\u0436\u0437");
  EXPECT_FALSE(set.has_all(other));
  CodePoints common = set;
  common.keep(other);
  EXPECT_EQ(common, code_points_of("\u0436"));
  set.add(other);
  EXPECT_TRUE(set.has_all(other));
  EXPECT_EQ(set.count(), 4U);
  set.truncate(2);
  EXPECT_EQ(set, code_points_of("\u0434\u0435"));
  set.remove(code_points_of("\u0434"));
  EXPECT_EQ(set, code_points_of("\u0435"));
}

}  // namespace
}  // namespace mesher::app
