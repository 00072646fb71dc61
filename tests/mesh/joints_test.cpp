#include "engine/mesh/joints.h"

#include <gtest/gtest.h>

#include <limits>

namespace mesher::test {
namespace {

struct Point {
  AttributeValue joints;
  AttributeValue weights;
};

AttributeLayer joint_layer(const std::string& name, std::uint8_t components = 4) {
  return {AttributeType{AttributeKind::joints, name, components, ComponentType::u8}, 0};
}

AttributeLayer weight_layer(const std::string& name, ComponentType component = ComponentType::f32,
                            std::uint8_t components = 4) {
  return {AttributeType{AttributeKind::weights, name, components, component,
                        component != ComponentType::f32},
          0};
}

/// One set of layers with these points, and one more value to store to.
std::vector<AttributeLayer> layers_of(const std::vector<Point>& points,
                                      ComponentType component = ComponentType::f32) {
  std::vector<AttributeLayer> layers{joint_layer("JOINTS_0"), weight_layer("WEIGHTS_0", component)};
  for (AttributeLayer& layer : layers)
    layer.resize(points.size() + 1);
  for (std::size_t i = 0; i < points.size(); ++i) {
    store(layers[0], i, points[i].joints);
    store(layers[1], i, points[i].weights);
  }
  return layers;
}

TEST(Joints, FindsSetsThatAreComplete) {
  const std::vector<AttributeLayer> layers{
      joint_layer("JOINTS_1"),    weight_layer("WEIGHTS_0"), joint_layer("JOINTS_0"),
      joint_layer("JOINTS_2", 3), weight_layer("WEIGHTS_1"), weight_layer("WEIGHTS_2"),
      joint_layer("JOINTS_3"),
  };
  const std::vector<JointSet> sets = joint_sets(layers);
  ASSERT_EQ(sets.size(), 2U) << "the third set has layers of different sizes";
  EXPECT_EQ(sets[0].joints, 2U);
  EXPECT_EQ(sets[0].weights, 1U);
  EXPECT_EQ(sets[1].joints, 0U);
  EXPECT_EQ(sets[1].weights, 4U);
  EXPECT_TRUE(joint_sets(std::vector{joint_layer("JOINTS_0")}).empty());
}

TEST(Joints, VisitsOnlyWeightsAboveZero) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const auto layers = layers_of({{{5, 6, 7, 8}, {0.5, 0.0, -0.25, nan}}});
  std::vector<std::pair<std::uint32_t, double>> visited;
  for_each_joint(layers, joint_sets(layers), 0,
                 [&](std::uint32_t joint, double weight) { visited.emplace_back(joint, weight); });
  EXPECT_EQ(visited, (std::vector<std::pair<std::uint32_t, double>>{{5, 0.5}}));
}

TEST(Joints, SumsTheSameJointOnce) {
  auto layers = layers_of({{{3, 9, 0, 0}, {0.75, 0.25, 0, 0}}, {{9, 4, 0, 0}, {0.5, 0.5, 0, 0}}});
  const auto sets = joint_sets(layers);
  JointSum sum;
  sum.add(layers, sets, 0, 0.5);
  sum.add(layers, sets, 1, 0.5);
  ASSERT_TRUE(sum.store(layers, sets, 2));
  // 3 and 9 have 0.375 each: the lower index comes first.
  EXPECT_EQ(load(layers[0], 2), (AttributeValue{3, 9, 4, 0}));
  EXPECT_EQ(load(layers[1], 2), (AttributeValue{0.375, 0.375, 0.25, 0}));
}

TEST(Joints, KeepsTheLargestAndTheSum) {
  auto layers =
      layers_of({{{1, 2, 3, 4}, {0.4, 0.3, 0.2, 0.1}}, {{5, 6, 7, 8}, {0.4, 0.3, 0.2, 0.1}}});
  const auto sets = joint_sets(layers);
  JointSum sum;
  sum.add(layers, sets, 0, 0.5);
  sum.add(layers, sets, 1, 0.5);
  ASSERT_TRUE(sum.store(layers, sets, 2));
  EXPECT_EQ(load(layers[0], 2), (AttributeValue{1, 5, 2, 6}));
  const AttributeValue weights = load(layers[1], 2);
  EXPECT_NEAR(weights[0], 0.2 / 0.7, 1e-6);
  EXPECT_NEAR(weights[0] + weights[1] + weights[2] + weights[3], 1.0, 1e-6);
}

TEST(Joints, RoundsIntegersToTheSameSum) {
  for (const ComponentType component : {ComponentType::u8, ComponentType::u16}) {
    const double one = component == ComponentType::u8 ? 255.0 : 65'535.0;
    for (int part = 1; part < 40; ++part) {
      auto layers = layers_of({{{1, 2, 3, 0}, {85 / one, 85 / one, (one - 170) / one, 0}},
                               {{4, 2, 1, 0}, {100 / one, 54 / one, (one - 154) / one, 0}}},
                              component);
      const auto sets = joint_sets(layers);
      JointSum sum;
      sum.add(layers, sets, 0, part / 40.0);
      sum.add(layers, sets, 1, 1.0 - part / 40.0);
      ASSERT_TRUE(sum.store(layers, sets, 2));
      const AttributeValue weights = load(layers[1], 2);
      EXPECT_NEAR(weights[0] + weights[1] + weights[2] + weights[3], 1.0, 1e-9);
    }
  }
}

TEST(Joints, AWeightThatRoundsToNothingNamesJointZero) {
  auto layers =
      layers_of({{{1, 0, 0, 0}, {1, 0, 0, 0}}, {{9, 0, 0, 0}, {1, 0, 0, 0}}}, ComponentType::u8);
  const auto sets = joint_sets(layers);
  JointSum sum;
  sum.add(layers, sets, 0, 0.999);
  sum.add(layers, sets, 1, 0.001);
  ASSERT_TRUE(sum.store(layers, sets, 2));
  EXPECT_EQ(load(layers[0], 2), (AttributeValue{1, 0, 0, 0}));
  EXPECT_EQ(load(layers[1], 2), (AttributeValue{1, 0, 0, 0}));
}

TEST(Joints, NothingToStore) {
  auto layers = layers_of({{{7, 7, 7, 7}, {0, 0, 0, 0}}});
  const auto sets = joint_sets(layers);
  store(layers[0], 1, {2, 2, 2, 2});
  JointSum sum;
  sum.add(layers, sets, 0, 1.0);
  EXPECT_FALSE(sum.store(layers, sets, 1));
  EXPECT_EQ(load(layers[0], 1), (AttributeValue{2, 2, 2, 2})) << "unchanged";
}

}  // namespace
}  // namespace mesher::test
