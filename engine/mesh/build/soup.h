#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <memory>
#include <vector>

#include "engine/core/array.h"
#include "engine/mesh/build/report.h"
#include "engine/mesh/contents.h"
#include "engine/mesh/corner_attributes.h"
#include "engine/mesh/ids.h"
#include "engine/mesh/material.h"
#include "engine/mesh/wedges.h"

namespace mesher {

/// A crease as in a file: an edge given by its vertices (indices into Soup::positions).
struct CreaseTag {
  std::uint32_t a = 0;
  std::uint32_t b = 0;
  float sharpness = 0.0F;
};

/// A vertex with its own sharpness (OpenSubdiv's corner).
struct CornerTag {
  std::uint32_t v = 0;
  float sharpness = 0.0F;
};

/// A polygon soup: faces as in a file, with no guarantees. Readers produce it, and `build_mesh`
/// turns it into a mesh.
struct Soup {
  Array<glm::vec3> positions;
  /// The position index of each corner, face after face.
  Array<std::uint32_t> corners;
  /// Empty if every face is a triangle. Otherwise F+1 offsets into `corners`: face f has corners
  /// [face_start[f], face_start[f+1]).
  Array<std::uint32_t> face_start;
  /// For each triangle, the polygon that it was cut from; empty if nothing was cut. Set by
  /// `triangulate`.
  Array<std::uint32_t> polygon_of;
  /// One value per corner of `corners` (not 3F if there are polygons); one group per face.
  CornerAttributes attributes;
  /// Further attributes. `index` has an element for each of `corners`.
  std::vector<AttributeStream> streams;
  /// What the groups of `attributes` refer to; null if the file has no materials.
  std::shared_ptr<const Materials> materials;
  std::vector<CreaseTag> creases;
  std::vector<CornerTag> corner_tags;
  /// Added to every position, in the file's own coordinates; 0 unless single precision about zero
  /// would lose digits.
  glm::dvec3 origin{0.0};
  FileContents contents;
  /// What the reader had to repair; `build_mesh` adds to it.
  BuildReport report;

  std::uint32_t face_count() const {
    return face_start.empty() ? static_cast<std::uint32_t>(corners.size() / 3)
                              : static_cast<std::uint32_t>(face_start.size() - 1);
  }
};

/// Turns the values of `attributes` into a stream, whose layers are named as in glTF. Groups stay.
/// O(corners).
void to_streams(Soup& soup);

}  // namespace mesher
