#include "engine/io/vertex_colors.h"

namespace mesher {

Array<glm::u8vec4> vertex_colors(const Mesh& mesh, const Attributes& attributes) {
  Array<glm::u8vec4> colors;
  if (attributes.color.empty()) return colors;
  colors.assign(mesh.vertex_count(), glm::u8vec4(255));
  const auto origins = mesh.origins();
  for (std::size_t h = 0; h < origins.size(); ++h) {
    colors[origins[h].index()] = attributes.color[h];
  }
  for (std::size_t h = 0; h < origins.size(); ++h) {
    if (colors[origins[h].index()] != attributes.color[h]) return {};
  }
  return colors;
}

}  // namespace mesher
