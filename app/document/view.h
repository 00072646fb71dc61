#pragma once

#include <glm/vec2.hpp>

#include "engine/render/camera.h"
#include "engine/render/settings.h"

namespace mesher::app {

/// How a document is looked at.
struct View {
  render::Settings settings;  ///< as chosen; `shown_settings` adds what the document asks for
  render::Camera camera;
  glm::dvec2 window{800.0, 600.0};  ///< width and height in pixels

  double aspect() const { return window.x / window.y; }
};

/// Sets the angle from which a model is first seen: a little from the right and above.
void set_default_view(render::Camera& camera);

}  // namespace mesher::app
