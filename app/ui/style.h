#pragma once

namespace mesher::app {

/// Font and colors of the panels. Call once after the ImGui context is made.
void apply_style();

}  // namespace mesher::app
