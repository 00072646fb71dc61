#pragma once

#include <cstdint>
#include <glm/gtc/type_precision.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <string>
#include <vector>

#include "engine/core/array.h"
#include "engine/mesh/attributes.h"
#include "engine/mesh/mesh.h"

namespace mesher {

/// The attributes that most file formats have, with one value per corner. Each array is empty or
/// has a value for every corner. A corner without a value has NaN (texture coordinate, normal).
struct CornerAttributes {
  Array<glm::vec2> texcoord;  ///< v counts from the bottom, as in OBJ
  Array<glm::vec3> normal;
  Array<glm::u8vec4> color;       ///< RGBA, 255 is full intensity
  bool has_linear_color = false;  ///< as AttributeType::is_linear
  Array<std::uint32_t> group;     ///< one per face (F, or empty): index into `groups`
  std::vector<FaceGroup> groups;

  bool is_empty() const { return !has_values() && group.empty(); }
  bool has_values() const { return !texcoord.empty() || !normal.empty() || !color.empty(); }
};

/// Returns the first texture coordinates, normals and colors of a mesh by corner, and its groups.
/// O(F), parallel.
CornerAttributes to_corners(const Mesh& mesh, const Attributes& attributes);

/// Returns attributes with the wedges that follow from values by corner. O(F), parallel.
Attributes to_wedges(const Mesh& mesh, CornerAttributes&& corners);

}  // namespace mesher
