#pragma once

#include <cstdint>
#include <glm/vec3.hpp>

#include "engine/core/array.h"
#include "engine/mesh/attributes.h"
#include "engine/mesh/ids.h"

namespace mesher {

/// A crease as a file names it: an edge by its vertices (indices into Soup::positions).
struct CreaseTag {
  std::uint32_t a = 0;
  std::uint32_t b = 0;
  float sharpness = 0.0F;
};

/// A vertex with a sharpness of its own (OpenSubdiv's corner).
struct CornerTag {
  std::uint32_t v = 0;
  float sharpness = 0.0F;
};

/// Faces as a file lists them, with no promise of anything: what readers produce and `build_mesh`
/// turns into a mesh.
struct Soup {
  Array<glm::vec3> positions;
  /// Position index of each corner, face after face.
  Array<std::uint32_t> corners;
  /// Empty where every face is a triangle. Otherwise F+1 offsets into `corners`: face f has corners
  /// [face_start[f], face_start[f+1]).
  Array<std::uint32_t> face_start;
  /// For each triangle the polygon that it was cut from; empty where nothing was cut. Set by
  /// `triangulate`.
  Array<std::uint32_t> polygon_of;
  /// One value a corner of `corners` (not 3F, where there are polygons); groups one a face.
  Attributes attributes;
  std::vector<CreaseTag> creases;
  std::vector<CornerTag> corner_tags;

  std::uint32_t face_count() const {
    return face_start.empty() ? static_cast<std::uint32_t>(corners.size() / 3)
                              : static_cast<std::uint32_t>(face_start.size() - 1);
  }
};

}  // namespace mesher
