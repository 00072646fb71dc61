#pragma once

#include <glm/vec3.hpp>

#include "engine/core/array.h"
#include "engine/subdivide/features.h"
#include "engine/subdivide/level.h"
#include "engine/subdivide/options.h"

namespace mesher::subdivide {

/// The limit of Loop subdivision at the vertices of a level.
struct LimitSurface {
  Array<glm::vec3> position;  ///< V
  Array<glm::vec3> normal;    ///< 3F: unit, one per corner; zero if the surface has no normal there
};

/// Returns the limit positions and normals of a level, exact by masks (C. Loop, 1987; H. Hoppe et
/// al., 1994). Semi-sharp vertices are subdivided until their sharpness is used up, so that the
/// limit does not depend on the level. O(F), parallel. Throws Cancelled.
LimitSurface limit_surface(const LevelView& level, const Features& features,
                           const SubdivideOptions& options);

}  // namespace mesher::subdivide
