#include "engine/subdivide/sharpness.h"

namespace mesher {

float chaikin_decayed(float sharpness, std::span<const float> others) {
  if (!is_semi_sharp(sharpness)) return decayed(sharpness);
  float sum = 0.0F;
  int count = 0;
  for (const float other : others) {
    if (!is_semi_sharp(other)) continue;
    sum += other;
    ++count;
  }
  if (count == 0) return decayed(sharpness);
  return std::max(0.75F * sharpness + 0.25F * sum / static_cast<float>(count) - 1.0F, 0.0F);
}

VertexRule vertex_rule(float own, std::size_t sharp_edges) {
  if (own > 0.0F || sharp_edges > 2) return VertexRule::corner;
  return sharp_edges == 2 ? VertexRule::crease : VertexRule::smooth;
}

}  // namespace mesher
