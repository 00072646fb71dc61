#include "engine/io/gltf_data.h"

#include <gtest/gtest.h>

#include "tests/support/bytes.h"

namespace mesher::io {
namespace {

std::string written(const GltfData& data) {
  test::StringSink sink;
  data.write(sink, nullptr);
  return sink.text;
}

TEST(GltfData, OverlappingRangesAreWrittenOnce) {
  const std::string bytes = "abcdefghijklmnop";
  const std::string_view view = bytes;
  GltfData data;
  data.keep(0, 8, view.substr(8, 4));
  data.keep(0, 0, view.substr(0, 4));
  data.keep(0, 2, view.substr(2, 4));
  data.arrange();
  EXPECT_EQ(written(data), std::string("abcdef\0\0ijkl", 12));
  EXPECT_EQ(data.offset(0, 0), 0U);
  EXPECT_EQ(data.offset(0, 2), 2U);
  EXPECT_EQ(data.offset(0, 8), 8U);
}

// What was aligned to a word in its buffer stays aligned.
TEST(GltfData, PlacesWithinAWordStay) {
  const std::string bytes = "abcdefgh";
  const std::string_view view = bytes;
  GltfData data;
  data.keep(1, 6, view.substr(6, 2));
  data.keep(0, 1, view.substr(1, 2));
  const std::size_t piece = data.add("xyz");
  data.arrange();
  EXPECT_EQ(data.offset(0, 1), 1U);
  EXPECT_EQ(data.offset(1, 6), 6U);
  EXPECT_EQ(data.piece_offset(piece), 8U);
  EXPECT_EQ(data.size(), 12U);
  EXPECT_EQ(written(data), std::string("\0bc\0\0\0ghxyz\0", 12));
}

TEST(GltfData, NothingIsNothing) {
  GltfData data;
  data.arrange();
  EXPECT_EQ(data.size(), 0U);
  EXPECT_EQ(written(data), "");
}

}  // namespace
}  // namespace mesher::io
