#include "engine/render/legend_colors.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>

#include "engine/render/line_edges.h"
#include "shaders/shared/split_order.h"

namespace mesher::render {

Color split_order_color(float share) {
  const auto encode = [](float c) {
    return c <= 0.0031308F ? 12.92F * c : 1.055F * std::pow(c, 1.0F / 2.4F) - 0.055F;
  };
  const glm::vec3 linear = shared::split_order_ramp(std::clamp(share, 0.0F, 1.0F));
  return {encode(linear.x), encode(linear.y), encode(linear.z)};
}

// As in shaders/line.vert.
CreaseStyle crease_style(float sharpness) {
  const float weight = line_weight(sharpness);
  return {kCreaseWidth * glm::mix(0.4F, 1.0F, weight), glm::mix(0.45F, 1.0F, weight)};
}

}  // namespace mesher::render
