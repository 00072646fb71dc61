#pragma once

#include <cstdint>
#include <glm/gtc/type_precision.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <string>
#include <vector>

#include "engine/core/array.h"

namespace mesher {

/// What a file says beyond shape, one value a corner (index 3*face + corner, that is, a half-edge),
/// each array either empty or 3F long, so that seams need nothing special. A corner that the file
/// leaves out has NaN (texture coordinate, normal).
struct Attributes {
  Array<glm::vec2> texcoord;
  Array<glm::vec3> normal;
  Array<glm::u8vec4> color;    ///< RGBA, 255 is full
  Array<std::uint32_t> group;  ///< one a face (F, or empty): index into `group_names`
  std::vector<std::string> group_names;

  bool is_empty() const {
    return texcoord.empty() && normal.empty() && color.empty() && group.empty();
  }
};

}  // namespace mesher
