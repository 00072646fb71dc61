#include "engine/mesh/packed_normal.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace mesher {

std::uint32_t encode_normal(const glm::vec3& normal) {
  const float sum = std::abs(normal.x) + std::abs(normal.y) + std::abs(normal.z);
  if (!(sum > 0.0F)) return 0;
  float x = normal.x / sum;
  float y = normal.y / sum;
  if (normal.z < 0.0F) {
    const float folded_x = std::copysign(1.0F - std::abs(y), normal.x);
    y = std::copysign(1.0F - std::abs(x), normal.y);
    x = folded_x;
  }
  const auto pack = [](float value) {
    const auto rounded = static_cast<std::int32_t>(std::lround(value * 32767.0F));
    return static_cast<std::uint32_t>(rounded) & 0xFFFFU;
  };
  return pack(x) | pack(y) << 16U;
}

glm::vec3 decode_normal(std::uint32_t packed) {
  const auto unpack = [](std::uint32_t bits) {
    const auto value = static_cast<std::int16_t>(static_cast<std::uint16_t>(bits));
    return std::clamp(static_cast<float>(value) / 32767.0F, -1.0F, 1.0F);
  };
  const float x = unpack(packed & 0xFFFFU);
  const float y = unpack(packed >> 16U);
  glm::vec3 n(x, y, 1.0F - std::abs(x) - std::abs(y));
  const float fold = std::max(-n.z, 0.0F);
  n.x += n.x >= 0.0F ? -fold : fold;
  n.y += n.y >= 0.0F ? -fold : fold;
  return glm::normalize(n);
}

}  // namespace mesher
