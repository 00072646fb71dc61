#include "engine/mesh/packed_normal.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <random>

namespace mesher {
namespace {

TEST(PackedNormal, RoundTripErrorIsBelow0004Degrees) {
  std::mt19937 random(3);
  std::normal_distribution<float> gauss;
  double worst = 0.0;
  for (int i = 0; i < 20000; ++i) {
    const glm::vec3 n = glm::normalize(glm::vec3(gauss(random), gauss(random), gauss(random)));
    const glm::vec3 d = decode_normal(encode_normal(n));
    EXPECT_NEAR(glm::length(d), 1.0F, 1e-6F);
    worst = std::max(worst, glm::length(glm::cross(glm::dvec3(d), glm::dvec3(n))));
  }
  EXPECT_LT(worst, 0.004 * 3.14159265 / 180.0);
}

TEST(PackedNormal, AxesRoundTripExactly) {
  for (int axis = 0; axis < 3; ++axis) {
    for (const float sign : {-1.0F, 1.0F}) {
      glm::vec3 n(0.0F);
      n[axis] = sign;
      EXPECT_EQ(decode_normal(encode_normal(n)), n) << axis << " " << sign;
    }
  }
}

TEST(PackedNormal, ZeroAndNanDecodeToUp) {
  EXPECT_EQ(encode_normal(glm::vec3(0.0F)), 0U);
  EXPECT_EQ(encode_normal(glm::vec3(std::nanf(""))), 0U);
  EXPECT_EQ(decode_normal(0U), glm::vec3(0, 0, 1));
}

TEST(PackedNormal, AnyBitsDecodeToAUnitVector) {
  std::mt19937 random(4);
  for (int i = 0; i < 20000; ++i) {
    EXPECT_NEAR(glm::length(decode_normal(static_cast<std::uint32_t>(random()))), 1.0F, 1e-6F);
  }
}

}  // namespace
}  // namespace mesher
