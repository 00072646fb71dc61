#include "app/ui/layout.h"

#include <algorithm>
#include <cmath>

namespace mesher::app {
namespace {

// Lengths in points.
constexpr float kFullWidth = 900.0F;
constexpr float kMediumWidth = 600.0F;
constexpr float kMediumHeight = 260.0F;
constexpr float kMenuHeight = 27.0F;
constexpr float kTabsHeight = 30.0F;
constexpr float kStatusHeight = 27.0F;
constexpr float kDetailHeight = 58.0F;
constexpr float kRailWidth = 40.0F;
constexpr float kFactsWidth = 244.0F;
constexpr float kPanelWidth = 316.0F;

Layout::Width width_of(const glm::vec2& points) {
  if (points.x < kMediumWidth || points.y < kMediumHeight) return Layout::Width::small;
  return points.x < kFullWidth ? Layout::Width::medium : Layout::Width::full;
}

}  // namespace

Layout layout_of(const glm::vec2& size, float scale, bool shows_docks, bool shows_tabs) {
  const auto units = [&](float points) { return std::round(points * scale); };
  Layout all;
  all.width = width_of(size / scale);
  const bool is_small = all.width == Layout::Width::small;
  const float top = is_small ? 0.0F : units(kMenuHeight);
  const float bottom = std::max(top, is_small ? size.y : size.y - units(kStatusHeight));
  const float left = std::min(units(kRailWidth), size.x);
  const float facts = all.width == Layout::Width::full && shows_docks ? units(kFactsWidth) : 0.0F;
  const float panel = shows_docks ? std::min(units(kPanelWidth), size.x - left) : 0.0F;
  const float right = is_small ? size.x : size.x - panel;
  const float low = std::max(top, bottom - units(kDetailHeight));
  const float under = shows_tabs && !is_small ? std::min(top + units(kTabsHeight), low) : top;
  all.tabs = {left + facts, top, right, under};
  all.menu = {0.0F, 0.0F, size.x, top};
  all.status = {0.0F, bottom, size.x, size.y};
  all.rail = {0.0F, top, left, bottom};
  all.facts = {left, top, left + facts, bottom};
  all.detail = {left + facts, low, right, bottom};
  all.panel = {size.x - panel, top, size.x, is_small ? low : bottom};
  all.model = {left + facts, under, right, low};
  return all;
}

bool fits_docks(const glm::dvec2& window, float pixels_per_point) {
  return width_of(glm::vec2(window) / pixels_per_point) == Layout::Width::full;
}

Insets insets_of(const Layout& layout, const glm::vec2& size, const glm::vec2& pixels) {
  const Rect& model = layout.model;
  return {std::round(model.x0 * pixels.x), std::round(model.y0 * pixels.y),
          std::round((size.x - model.x1) * pixels.x), std::round((size.y - model.y1) * pixels.y)};
}

}  // namespace mesher::app
