#include "app/ui/fonts.h"

#include <gtest/gtest.h>
#include <imgui.h>

#include "tests/support/temp_folder.h"

namespace mesher::app {
namespace {

// Comes with the font of the panels, DejaVu Sans, and has this glyph, which that has not.
constexpr const char* kMonoFont = "/usr/share/fonts/truetype/dejavu/DejaVuSansMono.ttf";
constexpr char32_t kMonoArc = 0x2312;
constexpr char32_t kSansZhe = 0x436;    // in DejaVu Sans
constexpr char32_t kGlyphless = 0x378;  // in no font

CodePoints set_of(std::initializer_list<char32_t> code_points) {
  CodePoints set;
  for (const char32_t c : code_points)
    set.add(c);
  return set;
}

class FontsTest : public testing::Test {
 protected:
  FontsTest() : context_(ImGui::CreateContext()) {}
  ~FontsTest() override { ImGui::DestroyContext(context_); }

  Fonts::Finder counted(Fonts::Finder find) {
    return [this, find = std::move(find)](const CodePoints& wanted) {
      ++searches_;
      return find(wanted);
    };
  }
  static const ImFontGlyph* glyph(char32_t c) {
    return ImGui::GetIO().Fonts->Fonts.front()->FindGlyphNoFallback(static_cast<ImWchar>(c));
  }

  ImGuiContext* context_;
  int searches_ = 0;
};

TEST_F(FontsTest, LatinNamesSearchNothing) {
  Fonts fonts(1.0F, 4096, counted(find_faces));
  CodePoints shown;
  shown.add_text("bunny_70k.obj");
  EXPECT_FALSE(fonts.require(shown));
  EXPECT_FALSE(fonts.update());
  EXPECT_EQ(searches_, 0);
}

TEST_F(FontsTest, PanelsFontIsUsedFirst) {
  Fonts fonts(1.0F, 4096, counted(find_faces));
  EXPECT_TRUE(fonts.require(set_of({kSansZhe})));
  EXPECT_TRUE(fonts.update());
  EXPECT_NE(glyph(kSansZhe), nullptr);
  EXPECT_NE(glyph('a'), nullptr);
  EXPECT_EQ(searches_, 0) << "DejaVu Sans has it";
  EXPECT_EQ(ImGui::GetIO().Fonts->Fonts.size(), 1);
}

TEST_F(FontsTest, SystemsFontIsMerged) {
  const CodePoints covers = set_of({kMonoArc, kMonoArc + 1, kSansZhe});
  Fonts fonts(1.0F, 4096, counted([&](const CodePoints& wanted) {
                EXPECT_EQ(wanted, set_of({kMonoArc})) << "not what the panels' font has";
                return std::vector<FontFace>{{kMonoFont, 0, covers}};
              }));
  EXPECT_TRUE(fonts.require(set_of({kSansZhe, kMonoArc})));
  EXPECT_TRUE(fonts.update());
  EXPECT_NE(glyph(kMonoArc), nullptr);
  EXPECT_NE(glyph(kSansZhe), nullptr);
  EXPECT_EQ(glyph(kMonoArc + 1), nullptr) << "only what was asked for";
  EXPECT_TRUE(fonts.absent().is_empty());
  EXPECT_EQ(searches_, 1);
  EXPECT_FLOAT_EQ(ImGui::GetIO().Fonts->Fonts.front()->FontSize, 15.0F);
  // Another glyph of the same face needs no search.
  EXPECT_TRUE(fonts.require(set_of({kMonoArc + 1})));
  EXPECT_TRUE(fonts.update());
  EXPECT_NE(glyph(kMonoArc), nullptr);
  EXPECT_NE(glyph(kMonoArc + 1), nullptr);
  EXPECT_EQ(searches_, 1);
}

TEST_F(FontsTest, FontIsBuiltOncePerSet) {
  Fonts fonts(1.0F, 4096, counted(find_faces));
  const CodePoints shown = set_of({kSansZhe, kGlyphless});
  EXPECT_TRUE(fonts.require(shown));
  EXPECT_FALSE(fonts.require(shown));
  EXPECT_TRUE(fonts.update());
  EXPECT_FALSE(fonts.update());
  EXPECT_FALSE(fonts.require(shown)) << "although one has no glyph";
  EXPECT_FALSE(fonts.require(set_of({kSansZhe})));
  EXPECT_EQ(fonts.absent(), set_of({kGlyphless}));
  EXPECT_TRUE(fonts.require(set_of({kSansZhe + 1, kGlyphless})));
  EXPECT_TRUE(fonts.update());
  EXPECT_EQ(searches_, 1) << "what no font has is searched for once";
}

TEST_F(FontsTest, WithoutFontsReplacementGlyphIsShown) {
  Fonts fonts(1.0F, 4096, [](const CodePoints&) { return std::vector<FontFace>(); });
  EXPECT_TRUE(fonts.require(set_of({0x5154})));
  EXPECT_TRUE(fonts.update());
  EXPECT_EQ(glyph(0x5154), nullptr);
  const ImFont& font = *ImGui::GetIO().Fonts->Fonts.front();
  ASSERT_NE(glyph(CodePoints::kReplacement), nullptr);
  EXPECT_EQ(font.FindGlyph(0x5154)->Codepoint, CodePoints::kReplacement);
}

TEST_F(FontsTest, UnreadableFontsAreIgnored) {
  const test::TempFolder folder;
  const CodePoints covers = set_of({0x5154});
  // A font file without tables, and one that is not there.
  const auto broken =
      folder.write("broken.ttf", std::string("\0\1\0\0", 4) + std::string(60, '\0'));
  Fonts fonts(1.0F, 4096, [&](const CodePoints&) {
    return std::vector<FontFace>{{broken, 0, covers}, {folder / "gone.ttf", 0, covers}};
  });
  EXPECT_TRUE(fonts.require(set_of({0x5154, kSansZhe})));
  EXPECT_TRUE(fonts.update());
  EXPECT_EQ(glyph(0x5154), nullptr);
  EXPECT_NE(glyph(kSansZhe), nullptr);
  EXPECT_EQ(fonts.absent(), covers);
}

TEST_F(FontsTest, GlyphsOfHiddenNamesGiveWay) {
  // A small device, on which some dozen glyphs fit.
  const std::size_t most = most_glyphs(15.0F, 256);
  ASSERT_GT(most, 10U);
  ASSERT_LT(most, 64U);
  Fonts fonts(1.0F, 256);
  CodePoints first;
  CodePoints second;
  CodePoints too_many;
  for (char32_t i = 0; i < most; ++i) {
    first.add(0x400 + i);
    second.add(0x500 + i);
    too_many.add(0x400 + i);
    too_many.add(0x1E00 + i);
  }
  EXPECT_TRUE(fonts.require(first));
  EXPECT_TRUE(fonts.update());
  EXPECT_NE(glyph(0x400), nullptr);
  EXPECT_TRUE(fonts.require(second));
  EXPECT_TRUE(fonts.update());
  EXPECT_EQ(glyph(0x400), nullptr);
  EXPECT_NE(glyph(0x500), nullptr);
  EXPECT_TRUE(fonts.require(too_many));
  EXPECT_TRUE(fonts.update());
  EXPECT_NE(glyph(0x400), nullptr);
  EXPECT_FALSE(fonts.require(too_many)) << "the rest does not fit in the next frame either";
  EXPECT_LE(ImGui::GetIO().Fonts->TexHeight, 256);
}

TEST_F(FontsTest, AtlasFitsDevice) {
  for (const float scale : {1.0F, 2.0F, 4.0F}) {
    SCOPED_TRACE(scale);
    Fonts fonts(scale, 4096);
    CodePoints shown;
    for (char32_t c = 0x100; c < 0x3000; ++c)
      shown.add(c);
    EXPECT_TRUE(fonts.require(shown));
    EXPECT_TRUE(fonts.update());
    EXPECT_LE(ImGui::GetIO().Fonts->TexWidth, 4096);
    EXPECT_LE(ImGui::GetIO().Fonts->TexHeight, 4096);
  }
  EXPECT_EQ(most_glyphs(15.0F, 16384), 4096U);
}

}  // namespace
}  // namespace mesher::app
