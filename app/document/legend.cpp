#include "app/document/legend.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "engine/core/text.h"
#include "engine/render/legend_colors.h"

namespace mesher::app {
namespace {

// Lengths in points.
constexpr float kPadding = 8.0F;
constexpr float kGap = 3.0F;
constexpr float kTextGap = 8.0F;

/// Length of the part of the scale that shows the color of the base.
constexpr float kBaseShare = 0.09F;

LegendScale split_order_scale(const render::Settings& settings, const LegendFacts& facts) {
  constexpr int kSteps = 64;
  constexpr float kColors = 1.0F - kBaseShare;
  LegendScale scale{.title = "split order [vertices]", .patches = {}, .marks = {}};
  scale.patches.push_back({0.0F, kBaseShare, kLegendBarPoints, settings.front});
  for (int i = 0; i < kSteps; ++i) {
    const float from = float(i) / kSteps;
    const float to = float(i + 1) / kSteps;
    scale.patches.push_back({kBaseShare + from * kColors, kBaseShare + to * kColors,
                             kLegendBarPoints, render::split_order_color(0.5F * (from + to))});
  }
  // The colors are even in the logarithm.
  const double middle = std::sqrt((facts.base_vertices + 1.0) * (facts.all_vertices + 1.0)) - 1.0;
  scale.marks = {{0.0F, "base: " + count_text(facts.base_vertices)},
                 {kBaseShare + 0.5F * kColors, count_text(std::llround(middle))},
                 {1.0F, count_text(facts.all_vertices)}};
  return scale;
}

LegendScale sharpness_scale(const render::Settings& settings) {
  constexpr std::array kSharpness{0.5F, 1.0F, 2.0F, 5.0F, kInfinitelySharp};
  constexpr float kCell = 1.0F / kSharpness.size();
  LegendScale scale{.title = "crease sharpness [levels]", .patches = {}, .marks = {}};
  for (std::size_t i = 0; i < kSharpness.size(); ++i) {
    const render::CreaseStyle style = render::crease_style(kSharpness[i]);
    const float from = kCell * static_cast<float>(i);
    scale.patches.push_back(
        {from + 0.12F * kCell, from + 0.88F * kCell, style.width, settings.crease, style.opacity});
    const bool is_finite = kSharpness[i] < kInfinitelySharp;
    scale.marks.push_back({from + 0.5F * kCell, is_finite ? number_text(kSharpness[i]) : "inf"});
  }
  return scale;
}

/// Draws the numbers below a scale: the outer ones within its ends, and none over another.
void draw_marks(const LegendScale& scale, float left, float width, float y,
                const LegendCanvas& canvas) {
  std::vector<glm::vec2> taken;
  const auto draw = [&](const LegendMark& mark) {
    const float length = canvas.text_width(mark.text);
    const float from = std::clamp(left + mark.at * width - 0.5F * length, left,
                                  std::max(left, left + width - length));
    const glm::vec2 place{from - kTextGap, from + length + kTextGap};
    const bool is_free = std::ranges::none_of(
        taken, [&](const glm::vec2& other) { return place.x < other.y && other.x < place.y; });
    if (!is_free) return;
    taken.emplace_back(from, from + length);
    canvas.text({from, y}, mark.text);
  };
  // The ends say more than what is between them.
  if (!scale.marks.empty()) draw(scale.marks.front());
  if (!scale.marks.empty()) draw(scale.marks.back());
  for (const LegendMark& mark : scale.marks)
    draw(mark);
}

}  // namespace

Legend legend_of(const render::Settings& settings, const LegendFacts& facts) {
  const bool is_light = settings.background == render::Background::light;
  Legend legend;
  legend.ground =
      is_light ? render::Color{0.953F, 0.957F, 0.965F} : render::Color{0.114F, 0.122F, 0.141F};
  legend.text = is_light ? render::Color{0.10F, 0.11F, 0.13F} : render::Color{0.93F, 0.94F, 0.96F};
  const bool has_surface = settings.shading != render::Shading::none;
  if (settings.colors_by_split_order && has_surface && facts.all_vertices > facts.base_vertices)
    legend.scales.push_back(split_order_scale(settings, facts));
  if ((settings.wireframe || settings.line_edges) && facts.crease_edges > 0)
    legend.scales.push_back(sharpness_scale(settings));
  return legend;
}

LegendFacts legend_facts(const Document& document) {
  LegendFacts facts{.crease_edges = document.statistics.crease_edges};
  if (document.progressive.is_on()) {
    const progressive::ProgressiveMesh& mesh = document.progressive.mesh();
    facts.base_vertices = mesh.base_vertex_count();
    facts.all_vertices = mesh.base_vertex_count() + mesh.split_count();
  }
  return facts;
}

float legend_height(const Legend& legend, float line) {
  const float scale = 2.0F * line + kLegendBarPoints + 2.0F * kGap;
  const auto scales = static_cast<float>(legend.scales.size());
  return 2.0F * kPadding + scales * scale + std::max(scales - 1.0F, 0.0F) * kPadding;
}

void draw_legend(const Legend& legend, float width, const LegendCanvas& canvas) {
  canvas.fill({0.0F, 0.0F}, {width, legend_height(legend, canvas.line)}, legend.ground,
              kLegendOpacity);
  const float length = width - 2.0F * kPadding;
  float y = kPadding;
  for (const LegendScale& scale : legend.scales) {
    canvas.text({kPadding, y}, scale.title);
    y += canvas.line + kGap;
    for (const LegendPatch& patch : scale.patches) {
      const float top = y + 0.5F * (kLegendBarPoints - patch.height);
      canvas.fill({kPadding + patch.from * length, top},
                  {kPadding + patch.to * length, top + patch.height}, patch.color, patch.opacity);
    }
    y += kLegendBarPoints + kGap;
    draw_marks(scale, kPadding, length, y, canvas);
    y += canvas.line + kPadding;
  }
}

}  // namespace mesher::app
