#include "engine/mesh/contents.h"

#include <gtest/gtest.h>

namespace mesher {
namespace {

TEST(FileContents, CountsAndNames) {
  FileContents contents;
  contents.add(Content::materials, "brick");
  EXPECT_EQ(contents.phrase(Content::materials), "1 material: brick");
  contents.add(Content::materials, "pa\nper");
  contents.add(Content::materials, "");
  EXPECT_EQ(contents[Content::materials], 3U);
  EXPECT_EQ(contents.phrase(Content::materials), "3 materials: brick, pa\\nper");
  contents[Content::points] += 2;
  EXPECT_EQ(contents.phrase(Content::points), "2 points");
  EXPECT_EQ(contents.phrase(Content::points, 1), "1 point");
}

TEST(FileContents, MemoryIsBounded) {
  FileContents contents;
  for (int i = 0; i < 1000; ++i)
    contents.add(Content::groups, std::string(1000, 'x'));
  EXPECT_EQ(contents[Content::groups], 1000U);
  EXPECT_EQ(contents.names(Content::groups).size(), FileContents::kMostNames);
  EXPECT_EQ(contents.names(Content::groups)[0].size(), FileContents::kMostNameBytes);
}

}  // namespace
}  // namespace mesher
