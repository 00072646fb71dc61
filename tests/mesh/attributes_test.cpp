#include "engine/mesh/attributes.h"

#include <gtest/gtest.h>

#include <cmath>

namespace mesher {
namespace {

AttributeLayer layer_of(ComponentType component, bool is_normalized) {
  return {{AttributeKind::custom, "_X", 2, component, is_normalized}, 3};
}

TEST(AttributeLayer, StoresEveryTypeOfComponent) {
  for (const ComponentType component :
       {ComponentType::s8, ComponentType::u8, ComponentType::s16, ComponentType::u16,
        ComponentType::u32, ComponentType::f32}) {
    AttributeLayer layer = layer_of(component, false);
    EXPECT_EQ(layer.bytes().size(), 3 * 2 * bytes_of(component));
    store(layer, 1, {100.0, 7.0, 0.0, 0.0});
    EXPECT_EQ(load(layer, 1), (AttributeValue{100.0, 7.0, 0.0, 0.0}));
  }
}

TEST(AttributeLayer, NormalizedIntegersAreFractions) {
  for (const ComponentType component :
       {ComponentType::s8, ComponentType::u8, ComponentType::s16, ComponentType::u16}) {
    AttributeLayer layer = layer_of(component, true);
    store(layer, 0, {1.0, 0.0, 0.0, 0.0});
    EXPECT_EQ(load(layer, 0), (AttributeValue{1.0, 0.0, 0.0, 0.0}));
  }
  AttributeLayer layer = layer_of(ComponentType::s8, true);
  layer.values<glm::i8vec2>()[0] = {-128, -127};
  EXPECT_EQ(load(layer, 0), (AttributeValue{-1.0, -1.0, 0.0, 0.0}));
}

TEST(AttributeLayer, IntegersAreRoundedAndClamped) {
  AttributeLayer layer = layer_of(ComponentType::u8, false);
  store(layer, 0, {2.5, -4.0, 0.0, 0.0});
  store(layer, 1, {300.0, std::nan(""), 0.0, 0.0});
  EXPECT_EQ(load(layer, 0), (AttributeValue{3.0, 0.0, 0.0, 0.0}));
  EXPECT_EQ(load(layer, 1), (AttributeValue{255.0, 0.0, 0.0, 0.0}));
}

TEST(AttributeLayer, MeanOfIntegersIsRoundedUp) {
  AttributeLayer layer = layer_of(ComponentType::u8, true);
  layer.values<glm::u8vec2>()[0] = {10, 255};
  layer.values<glm::u8vec2>()[1] = {13, 255};
  store_mean(layer, 2, layer, 0, 1);
  EXPECT_EQ(layer.values<glm::u8vec2>()[2], glm::u8vec2(12, 255));
}

TEST(AttributeLayer, AbsentValuesAreKnown) {
  AttributeLayer texcoords(texcoord_type(), 1);
  store_absent(texcoords, 0);
  EXPECT_TRUE(is_absent(texcoords, 0));
  store(texcoords, 0, {0.5, 0.5, 0.0, 0.0});
  EXPECT_FALSE(is_absent(texcoords, 0));
  AttributeLayer colors(color_type(), 1);
  store_absent(colors, 0);
  EXPECT_EQ(colors.values<glm::u8vec4>()[0], glm::u8vec4(255));
  EXPECT_FALSE(is_absent(colors, 0));
}

TEST(AttributeTypes, OnlyNumbersAreBlended) {
  EXPECT_TRUE(can_blend(texcoord_type()));
  EXPECT_TRUE(can_blend(color_type()));
  EXPECT_FALSE(can_blend({AttributeKind::joints, "JOINTS_0", 4, ComponentType::u8}));
  EXPECT_FALSE(can_blend({AttributeKind::weights, "WEIGHTS_0", 4, ComponentType::f32}));
  EXPECT_FALSE(can_blend({AttributeKind::custom, "_ID", 1, ComponentType::u32}));
}

}  // namespace
}  // namespace mesher
