#pragma once

namespace mesher::app {

/// Sets the font and the colors of the panels. Call once, after the ImGui context is created.
void apply_style();

}  // namespace mesher::app
