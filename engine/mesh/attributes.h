#pragma once

#include <cstdint>
#include <glm/gtc/type_precision.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <string>
#include <vector>

#include "engine/core/array.h"

namespace mesher {

/// The data of a file besides shape, one value per corner (index 3*face + corner, which is the
/// half-edge), so that seams need no special case. Each array is either empty or has 3F elements. A
/// corner without a value has NaN (texture coordinate, normal).
struct Attributes {
  Array<glm::vec2> texcoord;
  Array<glm::vec3> normal;
  Array<glm::u8vec4> color;    ///< RGBA, 255 is full intensity
  Array<std::uint32_t> group;  ///< one per face (F, or empty): index into `group_names`
  std::vector<std::string> group_names;

  bool is_empty() const {
    return texcoord.empty() && normal.empty() && color.empty() && group.empty();
  }
};

}  // namespace mesher
