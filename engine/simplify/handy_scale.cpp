#include "engine/simplify/handy_scale.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <limits>

#include "engine/mesh/statistics.h"

namespace mesher::simplify {

float handy_scale(const Mesh& mesh) {
  Box box{glm::vec3(std::numeric_limits<float>::max()),
          glm::vec3(std::numeric_limits<float>::lowest())};
  for (std::uint32_t v = 0; v < mesh.vertex_count(); ++v) {
    if (mesh.is_isolated(Vertex(v))) continue;
    box.min = glm::min(box.min, mesh.position(Vertex(v)));
    box.max = glm::max(box.max, mesh.position(Vertex(v)));
  }
  const double diagonal = box.is_empty() ? 0.0 : box.diagonal();
  if (!(diagonal > 0.0) || (diagonal > 0x1p-10 && diagonal < 0x1p20)) return 1.0F;
  return std::ldexp(1.0F, std::clamp(10 - std::ilogb(diagonal), -126, 126));
}

}  // namespace mesher::simplify
