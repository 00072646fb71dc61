#pragma once

#include <cstdint>

#include "engine/analysis/attributed_surface.h"
#include "engine/analysis/spread.h"
#include "engine/analysis/surface_matches.h"

namespace mesher::analysis {

/// How much wider the texture lies on a surface than on the original: lengths on the surface over
/// lengths on the original, both per unit of the texture. 1: the same.
struct UvStretch {
  Spread mean;  ///< over all directions: the root mean square of the two singular values. L2 of the
                ///< surface is its root mean square.
  Spread worst;  ///< the larger singular value. L infinity of the surface is its maximum.
};

/// Returns the stretch at the samples of `to` (P. Sander, J. Snyder, S. Gortler, H. Hoppe, "Texture
/// mapping progressive meshes", 2001, with the original in place of the plane of the texture).
/// `matches` are those from `to` on the original. Samples on faces whose texture coordinates have
/// no area are left out. O(samples + candidates), parallel; the same for any number of threads.
UvStretch uv_stretch(const AttributedSurface& original, const AttributedSurface& to,
                     const SurfaceMatches& matches);

}  // namespace mesher::analysis
