#pragma once

#include <glm/vec3.hpp>

#include "engine/render/settings.h"

namespace mesher::app {

/// The colors of the panels. Text on `panel`, `field`, `button`, `hovered` and `active` has a
/// contrast of at least 4.5:1 (WCAG 2.1, 1.4.3).
struct Theme {
  glm::vec3 panel;    ///< ground of panels, bars, menus
  glm::vec3 field;    ///< ground of what can be edited
  glm::vec3 button;   ///< ground of buttons
  glm::vec3 hovered;  ///< ground of what the mouse is over
  glm::vec3 active;   ///< ground of what is pressed or chosen
  glm::vec3 line;     ///< between parts
  glm::vec3 grab;     ///< knob of a slider, check mark; also the text of headings
  glm::vec3 text;
  glm::vec3 faint;    ///< labels
  glm::vec3 caution;  ///< text of a remark that needs an answer
  glm::vec3 problem;  ///< text of an error
};

/// The theme that goes with a background of the model.
const Theme& theme(render::Background background);

/// Size of the font of the panels.
inline constexpr float kFontPoints = 15.0F;

/// Sets sizes other than that of the font. `scale`: ImGui's units per point.
void set_sizes(float scale);
/// Sets the colors of ImGui for the frames to come.
void set_colors(const Theme& theme);
/// The theme that was set last.
const Theme& shown_theme();
/// ImGui's units of a length in points.
float units(float points);

}  // namespace mesher::app
