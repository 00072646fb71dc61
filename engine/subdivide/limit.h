#pragma once

#include <glm/vec3.hpp>

#include "engine/core/array.h"
#include "engine/subdivide/features.h"
#include "engine/subdivide/level.h"
#include "engine/subdivide/options.h"

namespace mesher {

/// What Loop subdivision, carried on for ever, makes of a level's vertices.
struct LimitSurface {
  Array<glm::vec3> position;  ///< V
  Array<glm::vec3> normal;    ///< 3F: unit, one a corner; zero where the surface has none
};

/// Exact by masks (C. Loop, 1987; H. Hoppe et al., 1994); semi-sharp vertices are followed until
/// their sharpness is used up, so that the limit does not depend on the level it is taken from.
/// O(F), parallel. Throws Cancelled.
LimitSurface limit_surface(const LevelView& level, const Features& features,
                           const SubdivideOptions& options);

}  // namespace mesher
