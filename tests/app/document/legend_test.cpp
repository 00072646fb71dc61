#include "app/document/legend.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace mesher::app {
namespace {

constexpr LegendFacts kFacts{.crease_edges = 12, .base_vertices = 102, .all_vertices = 1440};

std::vector<std::string> titles(const Legend& legend) {
  std::vector<std::string> all;
  for (const LegendScale& scale : legend.scales)
    all.push_back(scale.title);
  return all;
}

TEST(Legend, ExplainsOnlyWhatIsDrawn) {
  render::Settings settings;
  EXPECT_TRUE(legend_of(settings, kFacts).is_empty()) << "no lines, and one color";
  settings.line_edges = true;
  EXPECT_EQ(titles(legend_of(settings, kFacts)),
            std::vector<std::string>{"crease sharpness [levels]"});
  EXPECT_TRUE(legend_of(settings, {}).is_empty()) << "there is no crease";
  settings.colors_by_split_order = true;
  EXPECT_EQ(legend_of(settings, kFacts).scales.size(), 2U);
  settings.shading = render::Shading::none;
  EXPECT_EQ(legend_of(settings, kFacts).scales.size(), 1U) << "there is no surface";
}

TEST(Legend, ScalesRunFromTheBaseToAllVertices) {
  render::Settings settings;
  settings.colors_by_split_order = true;
  const Legend legend = legend_of(settings, kFacts);
  ASSERT_EQ(legend.scales.size(), 1U);
  const LegendScale& scale = legend.scales[0];
  ASSERT_EQ(scale.marks.size(), 3U);
  EXPECT_EQ(scale.marks.front().text, "base: 102");
  EXPECT_EQ(scale.marks.back().text, "1,440");
  EXPECT_EQ(scale.patches.front().color, settings.front);
  const auto lightness = [](const render::Color& c) { return c.x + c.y + c.z; };
  EXPECT_LT(lightness(scale.patches[1].color), lightness(scale.patches.back().color));
  for (std::size_t i = 1; i < scale.patches.size(); ++i)
    EXPECT_FLOAT_EQ(scale.patches[i].from, scale.patches[i - 1].to);
}

TEST(Legend, SharperCreasesAreWider) {
  render::Settings settings;
  settings.wireframe = true;
  const Legend legend = legend_of(settings, kFacts);
  const auto& patches = legend.scales.at(0).patches;
  for (std::size_t i = 1; i < patches.size(); ++i) {
    EXPECT_GT(patches[i].height, patches[i - 1].height);
    EXPECT_GT(patches[i].opacity, patches[i - 1].opacity);
  }
  EXPECT_EQ(legend.scales[0].marks.back().text, "inf");
}

TEST(Legend, DrawsNoTextOverAnother) {
  render::Settings settings;
  settings.colors_by_split_order = true;
  settings.wireframe = true;
  const Legend legend = legend_of(settings, kFacts);
  for (const float width : {120.0F, 160.0F, kLegendWidthPoints}) {
    std::vector<glm::vec4> texts;
    const auto width_of = [](const std::string& text) { return 7.0F * float(text.size()); };
    draw_legend(legend, width,
                {.fill =
                     [&](glm::vec2 from, glm::vec2 to, const render::Color&, float) {
                       EXPECT_GE(from.x, 0.0F);
                       EXPECT_LE(to.x, width + 0.01F);
                       EXPECT_LE(to.y, legend_height(legend, 17.0F));
                     },
                 .text =
                     [&](glm::vec2 at, const std::string& text) {
                       texts.emplace_back(at.x, at.y, at.x + width_of(text), at.y + 17.0F);
                     },
                 .text_width = width_of,
                 .line = 17.0F});
    for (std::size_t i = 0; i < texts.size(); ++i) {
      for (std::size_t j = i + 1; j < texts.size(); ++j) {
        const bool is_apart = texts[i].z <= texts[j].x || texts[j].z <= texts[i].x ||
                              texts[i].w <= texts[j].y || texts[j].w <= texts[i].y;
        EXPECT_TRUE(is_apart) << i << " and " << j << " at " << width;
      }
    }
  }
}

}  // namespace
}  // namespace mesher::app
