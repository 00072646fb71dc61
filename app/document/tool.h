#pragma once

#include "engine/core/choice.h"

namespace mesher::app {

/// The tools of the rail. The panel of one of them is shown at a time.
enum class Tool { model, look, simplify, subdivide, creases, levels };

inline constexpr Choices<Tool, 6> kTools{{
    {Tool::model, {"model", "Model", "counts, history, size and repairs"}},
    {Tool::look, {"look", "Look", "shading, lines and colors"}},
    {Tool::simplify, {"simplify", "Simplify", "fewer faces by edge collapse"}},
    {Tool::subdivide, {"subdivide", "Subdivide", "smoother surfaces with more faces"}},
    {Tool::creases, {"creases", "Creases", "edges that stay sharp in a subdivision"}},
    {Tool::levels, {"levels", "Levels", "progressive mesh: all levels of detail"}},
}};
static_assert(is_complete(kTools));
constexpr const auto& choices(Tool) {
  return kTools;
}

}  // namespace mesher::app
