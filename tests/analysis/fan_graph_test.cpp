#include "engine/analysis/fan_graph.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/support/meshes.h"

namespace mesher::test {
namespace {

/// Faces around the origin, which is the first vertex. The corners on the rim go around it `turns`
/// times, at these heights in turn.
Soup fan(std::uint32_t faces, float turns, bool is_closed, std::vector<float> heights) {
  Soup soup;
  soup.positions.emplace_back(0.0F);
  const std::uint32_t corners = is_closed ? faces : faces + 1;
  for (std::uint32_t i = 0; i < corners; ++i) {
    const float angle = 2.0F * std::numbers::pi_v<float> * turns * static_cast<float>(i) /
                        static_cast<float>(faces);
    soup.positions.emplace_back(std::cos(angle), std::sin(angle), heights[i % heights.size()]);
  }
  for (std::uint32_t i = 0; i < faces; ++i) {
    for (const std::uint32_t v : {0U, 1 + i, 1 + (i + 1) % corners})
      soup.corners.push_back(v);
  }
  return soup;
}

bool is_graph(Soup soup) {
  return analysis::find_graphs(built(std::move(soup)).mesh)[0] != 0;
}

TEST(FanGraph, FlatFansConesAndSaddlesAre) {
  EXPECT_TRUE(is_graph(fan(6, 1.0F, true, {0.0F})));
  EXPECT_TRUE(is_graph(fan(6, 1.0F, true, {-5.0F})));
  EXPECT_TRUE(is_graph(fan(8, 1.0F, true, {0.5F, 0.0F, -0.5F, 0.0F})));
  EXPECT_TRUE(is_graph(fan(6, 0.4F, false, {0.0F})));
  EXPECT_TRUE(is_graph(fan(1, 0.2F, false, {0.0F})));
}

TEST(FanGraph, FansThatGoAroundTwiceAreNot) {
  EXPECT_FALSE(is_graph(fan(12, 2.0F, true, {0.0F})));
  EXPECT_FALSE(is_graph(fan(12, 1.2F, false, {0.0F})));
}

TEST(FanGraph, FoldedFansAreNot) {
  Soup soup = fan(6, 1.0F, true, {0.0F});
  soup.positions[1] = {-0.5F, 0.1F, 0.0F};
  EXPECT_FALSE(is_graph(std::move(soup)));
}

TEST(FanGraph, FansWhoseNormalsCancelAreNot) {
  Soup soup = fan(4, 1.0F, true, {0.0F});
  soup.positions[3] = soup.positions[1] + glm::vec3(0, 0, 1e-12F);
  soup.positions[4] = soup.positions[2] - glm::vec3(0, 0, 1e-12F);
  EXPECT_FALSE(is_graph(std::move(soup)));
}

TEST(FanGraph, ManyFacesAndFacesWithoutAreaDoNotCount) {
  EXPECT_TRUE(is_graph(fan(32, 1.0F, true, {0.0F})));
  EXPECT_FALSE(is_graph(fan(33, 1.0F, true, {0.0F})));
  Soup soup = fan(6, 1.0F, true, {0.0F});
  soup.positions[2] = soup.positions[1];
  EXPECT_FALSE(is_graph(std::move(soup)));
}

TEST(FanGraph, WorksAtTheEndsOfTheFloatRange) {
  for (const float scale : {1e-37F, 1e37F}) {
    Soup soup = fan(8, 1.0F, true, {0.5F, 0.0F, -0.5F, 0.0F});
    for (glm::vec3& p : soup.positions)
      p *= scale;
    EXPECT_TRUE(is_graph(std::move(soup))) << scale;
  }
}

}  // namespace
}  // namespace mesher::test
