#pragma once

#include <glm/vec2.hpp>

#include "app/document/view.h"

namespace mesher::app {

/// A rectangle of the window, in ImGui's units.
struct Rect {
  float x0 = 0.0F;
  float y0 = 0.0F;
  float x1 = 0.0F;
  float y1 = 0.0F;

  float width() const { return x1 - x0; }
  float height() const { return y1 - y0; }
  bool is_empty() const { return x1 <= x0 || y1 <= y0; }
};

/// Where each part of the window is. An empty rectangle: the part is not shown. The parts other
/// than the model do not overlap, and together with the model they fill the window. The one
/// exception: in the smallest windows the tool's panel lies over the model.
struct Layout {
  enum class Width {
    full,    ///< docks at both sides of the model
    medium,  ///< the tool's panel only; the facts of the model are one of the tools
    small,   ///< no menu bar and no status line; the tool's panel lies over the model
  };
  Width width = Width::full;
  Rect menu;    ///< at the top
  Rect tabs;    ///< the open models, above the shown one
  Rect rail;    ///< the tools, at the left
  Rect facts;   ///< of the model, beside the rail
  Rect panel;   ///< of the tool, at the right
  Rect detail;  ///< the slider for the level of detail, below the model
  Rect status;  ///< at the bottom
  Rect model;
};

/// Divides a window of this size. `scale`: ImGui's units per point, which is as long as a pixel at
/// 96 dpi. `shows_docks`: the facts and the tool's panel are wanted. `shows_tabs`: several models
/// are open.
Layout layout_of(const glm::vec2& size, float scale, bool shows_docks, bool shows_tabs);

/// Returns whether a window of this size in pixels has room for docks at both sides of the model.
bool fits_docks(const glm::dvec2& window, float pixels_per_point);

/// Returns what lies beside the model, in pixels. `pixels`: of one of ImGui's units.
Insets insets_of(const Layout& layout, const glm::vec2& size, const glm::vec2& pixels);

}  // namespace mesher::app
