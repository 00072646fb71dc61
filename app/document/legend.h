#pragma once

#include <cstdint>
#include <functional>
#include <glm/vec2.hpp>
#include <string>
#include <vector>

#include "app/document/document.h"
#include "engine/render/settings.h"

namespace mesher::app {

/// A patch of color on the scale of a legend.
struct LegendPatch {
  float from = 0.0F;  ///< in shares of the scale's length
  float to = 1.0F;
  float height = 1.0F;  ///< in points, at most kLegendBarPoints
  render::Color color{0.0F};
  float opacity = 1.0F;
};

/// A number below the scale.
struct LegendMark {
  float at = 0.0F;  ///< in shares of the scale's length
  std::string text;
};

/// What stands for the values of one quantity.
struct LegendScale {
  std::string title;  ///< "split order [vertices]"
  std::vector<LegendPatch> patches;
  std::vector<LegendMark> marks;
};

/// Explains what is colored by a value, in the picture that it is drawn over.
struct Legend {
  std::vector<LegendScale> scales;
  render::Color ground{1.0F};
  render::Color text{0.0F};
  bool is_empty() const { return scales.empty(); }
};

/// What a legend is about.
struct LegendFacts {
  std::uint32_t crease_edges = 0;
  std::uint32_t base_vertices = 0;  ///< of the progressive mesh that is colored by split order
  std::uint32_t all_vertices = 0;
};

/// `settings`: as the renderer takes them.
Legend legend_of(const render::Settings& settings, const LegendFacts& facts);
/// Of what the document shows.
LegendFacts legend_facts(const Document& document);

inline constexpr float kLegendWidthPoints = 216.0F;
inline constexpr float kLegendBarPoints = 10.0F;
inline constexpr float kLegendOpacity = 0.88F;

/// Where a legend is drawn: the window, or a picture. Lengths are in points, from the legend's
/// upper left corner.
struct LegendCanvas {
  std::function<void(glm::vec2 from, glm::vec2 to, const render::Color& color, float opacity)> fill;
  std::function<void(glm::vec2 at, const std::string& text)> text;
  std::function<float(const std::string& text)> text_width;
  float line = 0.0F;  ///< height of a line of text
};

/// Height of a legend on a canvas with lines of this height, in points.
float legend_height(const Legend& legend, float line);
void draw_legend(const Legend& legend, float width, const LegendCanvas& canvas);

}  // namespace mesher::app
