#pragma once

#include "engine/render/settings.h"

namespace mesher::render {

// What the renderer draws for a value, for legends. Lit surfaces are lighter and darker.

/// Returns the color of a vertex at `share` of the split order: 0 is the first split, 1 the last.
Color split_order_color(float share);

/// How the renderer draws a crease of some sharpness.
struct CreaseStyle {
  float width = 0.0F;    ///< of the line, in pixels of a window of medium height
  float opacity = 1.0F;  ///< of Settings::crease
};
CreaseStyle crease_style(float sharpness);

}  // namespace mesher::render
