#pragma once

#include <cstdint>

#include "engine/analysis/attributed_surface.h"
#include "engine/analysis/triangle_tree.h"
#include "engine/core/progress.h"

namespace mesher::analysis {

/// Faces whose triangle of the texture is turned over.
struct FlippedUvs {
  std::uint32_t flipped = 0;
  std::uint32_t compared = 0;  ///< faces with texture coordinates that have an orientation
  double flipped_area = 0.0;   ///< on the surface, in squared model units
  double compared_area = 0.0;  ///< likewise

  FlippedUvs& operator+=(const FlippedUvs& other);
};

/// Counts the faces of `surface` whose texture coordinates run the other way around than those of
/// the original at the point that is nearest to the center of the face. So mirrored charts of the
/// original are no error. Only faces of the original that look the same way count, because the
/// nearest one may be the other side of a thin sheet; a face that finds none is not compared.
/// `tree` is that of the original. O(F log F) expected, parallel. Throws Cancelled.
FlippedUvs flipped_uvs(const AttributedSurface& original, const TriangleTree& tree,
                       const AttributedSurface& surface, Progress* progress = nullptr);

}  // namespace mesher::analysis
