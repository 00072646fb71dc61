#pragma once

#include <glm/vec2.hpp>

#include "engine/render/camera.h"

namespace mesher::render {

/// What one picture shows.
struct PictureView {
  Camera camera;
  glm::uvec2 size{1};  ///< of the whole picture, in pixels that are drawn

  friend bool operator==(const PictureView&, const PictureView&) = default;
};

}  // namespace mesher::render
