#pragma once

#include <cstdint>
#include <glm/vec2.hpp>

#include "engine/mesh/statistics.h"
#include "engine/progressive/level_errors.h"
#include "engine/render/camera.h"

namespace mesher::app {

/// Returns the level of a progressive mesh to show at `pixels_per_unit`. It is a finer level than
/// the current one if the current screen-space error exceeds `tolerance` pixels. It is a coarser
/// one only if that level's error is below four fifths of the tolerance, so that small camera moves
/// do not change the level. O(log splits).
std::uint32_t automatic_level(const progressive::LevelErrors& errors, std::uint32_t level,
                              double tolerance, double pixels_per_unit);

/// Returns the size of a model unit on the screen, in pixels, at the nearest corner of the model's
/// bounding box. If the eye is close to the box or inside it, a twentieth of the box's diagonal is
/// used as the distance.
double pixels_per_unit(const render::Camera& camera, const Box& box, const glm::dvec2& window);

}  // namespace mesher::app
