#pragma once

#include <cstdint>
#include <glm/vec2.hpp>

#include "engine/core/array.h"
#include "engine/core/progress.h"
#include "engine/mesh/statistics.h"
#include "engine/progressive/progressive_mesh.h"
#include "engine/render/camera.h"

namespace mesher::app {

/// About how far the levels of a progressive mesh lie from its full detail: the farthest that any
/// split above a level moves the surface, which is measured between the faces around its vertices
/// before and after. Falls from the base to 0 at full detail. An estimate: what splits move one
/// after the other is not added up.
class LevelErrors {
 public:
  LevelErrors() = default;
  /// Walks down from full detail, and leaves `mesh` at its level. O(splits); 4 bytes a split.
  /// Throws Cancelled.
  explicit LevelErrors(ProgressiveMesh& mesh, Progress* progress = nullptr);

  /// In model units. Pre: level <= splits.
  double error(std::uint32_t level) const;
  /// The coarsest level that is off by no more than `error`. O(log splits).
  std::uint32_t level_within(double error) const;

 private:
  Array<float> errors_;  ///< of each level but the last
};

/// By which a level is chosen where `pixels_a_unit` is so much. Above `tolerance` pixels it gets
/// finer at once; it gets coarser only where that is off by less than four fifths of it, so that
/// small moves of the camera change nothing.
std::uint32_t automatic_level(const LevelErrors& errors, std::uint32_t level, double tolerance,
                              double pixels_a_unit);

/// How large a model unit is on the screen where the model is nearest to the eye: at the nearest
/// corner of its box, or where the eye is close to it or inside, at a twentieth of the box's
/// diagonal.
double pixels_a_unit(const render::Camera& camera, const Box& box, const glm::dvec2& window);

}  // namespace mesher::app
