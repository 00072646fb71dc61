#pragma once

#include <cstdint>
#include <glm/vec2.hpp>

#include "engine/mesh/statistics.h"
#include "engine/progressive/level_errors.h"
#include "engine/render/camera.h"

namespace mesher::app {

/// Returns the level of a progressive mesh to show at `pixels_per_unit`. Where the current level's
/// screen-space error exceeds `tolerance` pixels, that is a finer level. It is a coarser one only
/// where the coarser level's error is below four fifths of the tolerance, so that small moves of
/// the camera change nothing. O(log splits).
std::uint32_t automatic_level(const LevelErrors& errors, std::uint32_t level, double tolerance,
                              double pixels_per_unit);

/// Returns the size of a model unit on the screen, in pixels, at the nearest corner of the model's
/// bounding box. Where the eye is close to the box or inside it, the distance is a twentieth of the
/// box's diagonal.
double pixels_per_unit(const render::Camera& camera, const Box& box, const glm::dvec2& window);

}  // namespace mesher::app
