#pragma once

#include "engine/analysis/attributed_surface.h"
#include "engine/analysis/spread.h"
#include "engine/analysis/surface_matches.h"

namespace mesher::analysis {

/// The normals that a surface is shaded with: those of the file, interpolated over each face, or
/// those of the faces where the file has none, as glTF asks for and mesher draws. Refers to the
/// surface.
class ShadingNormals {
 public:
  explicit ShadingNormals(const AttributedSurface& surface);

  /// Returns whether the file has normals.
  bool is_of_file() const { return layer_ != nullptr; }
  /// Returns the unit normal. Returns zero if there are no normals and the face has no area. O(1).
  glm::dvec3 at(const SurfacePoint& point) const;

 private:
  const AttributedSurface& surface_;
  const AttributeLayer* layer_ = nullptr;
};

/// Returns the angles in degrees, 0 to 180, between the shading normals at samples of `from` and at
/// the nearest points of `to`. Of several nearest points the one with the least angle counts, so
/// that hard edges and second sides are no error. Samples without a normal on either side are left
/// out. `matches` are those of the two meshes. O(samples + candidates), parallel; the same for any
/// number of threads.
Spread normal_deviation(const AttributedSurface& from, const AttributedSurface& to,
                        const SurfaceMatches& matches);

}  // namespace mesher::analysis
