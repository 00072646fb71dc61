#include "engine/subdivide/sharpness.h"

namespace mesher::subdivide {

float chaikin_decayed(float sharpness, const SemiSharpSum& at_end) {
  if (!is_semi_sharp(sharpness) || !at_end.has_others()) return decayed(sharpness);
  const double mean = 0.75 * sharpness + 0.25 * at_end.mean_of_others(sharpness);
  return static_cast<float>(std::max(mean - 1.0, 0.0));
}

VertexRule vertex_rule(float own, std::size_t sharp_edges) {
  if (own > 0.0F || sharp_edges > 2) return VertexRule::corner;
  return sharp_edges == 2 ? VertexRule::crease : VertexRule::smooth;
}

}  // namespace mesher::subdivide
