#include "app/ui/font_finder.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace mesher::app {
namespace {

// In DejaVu Sans Mono, which comes with the font of the panels, but not in DejaVu Sans.
constexpr char32_t kArc = 0x2312;
// A code point that is not assigned, and so in no font.
constexpr char32_t kUnassigned = 0x0378;

TEST(FontFinder, FindsFaceThatCoversCodePoint) {
  CodePoints wanted;
  wanted.add(kArc);
  const std::vector<FontFace> faces = find_faces(wanted);
  ASSERT_EQ(faces.size(), 1U);
  EXPECT_TRUE(faces[0].covers.has(kArc));
  EXPECT_TRUE(faces[0].covers.has('a')) << "all that it covers, not only what was asked for";
  EXPECT_FALSE(faces[0].covers.has(kUnassigned));
  EXPECT_TRUE(std::filesystem::is_regular_file(faces[0].file));
}

TEST(FontFinder, EachFaceAddsSomething) {
  CodePoints missing;
  for (const char32_t c : {char32_t(0x436), char32_t(0x627), kArc, char32_t(0x5154)})
    missing.add(c);
  for (const FontFace& face : find_faces(missing)) {
    CodePoints gained = missing;
    gained.keep(face.covers);
    EXPECT_FALSE(gained.is_empty()) << face.file;
    missing.remove(face.covers);
  }
  EXPECT_FALSE(missing.has(0x436));
  EXPECT_FALSE(missing.has(0x627));
  EXPECT_FALSE(missing.has(kArc));
}

TEST(FontFinder, NothingCoversWhatIsUnassigned) {
  CodePoints wanted;
  wanted.add(kUnassigned);
  EXPECT_TRUE(find_faces(wanted).empty());
}

}  // namespace
}  // namespace mesher::app
