#include "engine/subdivide/sharpness.h"

#include <gtest/gtest.h>

#include <cmath>
#include <initializer_list>
#include <utility>

#include "engine/subdivide/options.h"

namespace mesher {
namespace {

float chaikin(float sharpness, std::initializer_list<float> others) {
  subdivide::SemiSharpSum at_end;
  at_end.add(sharpness);
  for (const float other : others)
    at_end.add(other);
  return subdivide::chaikin_decayed(sharpness, at_end);
}

TEST(Sharpness, DecreasesByOnePerLevel) {
  EXPECT_EQ(subdivide::decayed(0.0F), 0.0F);
  EXPECT_EQ(subdivide::decayed(0.75F), 0.0F);
  EXPECT_EQ(subdivide::decayed(1.0F), 0.0F);
  EXPECT_EQ(subdivide::decayed(1.25F), 0.25F);
  EXPECT_EQ(subdivide::decayed(9.5F), 8.5F);
}

TEST(Sharpness, IsInfiniteFromTenOn) {
  for (const float s : {10.0F, 10.5F, 1e9F, kInfinitelySharp}) {
    EXPECT_EQ(subdivide::decayed(s), kInfinitelySharp) << s;
    EXPECT_EQ(chaikin(s, {1.0F}), kInfinitelySharp) << s;
    EXPECT_FALSE(subdivide::is_semi_sharp(s)) << s;
  }
  EXPECT_TRUE(subdivide::is_semi_sharp(std::nextafter(10.0F, 0.0F)));
  EXPECT_TRUE(subdivide::is_semi_sharp(0.01F));
  EXPECT_FALSE(subdivide::is_semi_sharp(0.0F));
}

TEST(ChaikinDecay, AveragesWithTheOtherEdgesMinusOne) {
  EXPECT_EQ(chaikin(2.0F, {1.0F}), 0.75F);
  EXPECT_EQ(chaikin(2.0F, {2.0F}), 1.0F);
  EXPECT_EQ(chaikin(2.0F, {1.0F, 3.0F}), 1.0F);
  EXPECT_EQ(chaikin(1.0F, {5.0F}), 1.0F);
  EXPECT_EQ(chaikin(0.5F, {0.5F}), 0.0F);
  EXPECT_EQ(chaikin(0.0F, {9.0F}), 0.0F);
}

TEST(ChaikinDecay, IgnoresSmoothAndInfinitelySharpEdges) {
  EXPECT_EQ(chaikin(2.0F, {}), 1.0F);
  EXPECT_EQ(chaikin(2.0F, {0.0F, kInfinitelySharp, 10.0F}), 1.0F);
  EXPECT_EQ(chaikin(2.0F, {0.0F, kInfinitelySharp, 1.0F, 10.0F}), 0.75F);
}

TEST(VertexRule, DependsOnTheNumberOfSharpEdges) {
  EXPECT_EQ(subdivide::vertex_rule(0.0F, 0), subdivide::VertexRule::smooth);
  EXPECT_EQ(subdivide::vertex_rule(0.0F, 1), subdivide::VertexRule::smooth);
  EXPECT_EQ(subdivide::vertex_rule(0.0F, 2), subdivide::VertexRule::crease);
  EXPECT_EQ(subdivide::vertex_rule(0.0F, 3), subdivide::VertexRule::corner);
  EXPECT_EQ(subdivide::vertex_rule(0.1F, 0), subdivide::VertexRule::corner);
  EXPECT_EQ(subdivide::vertex_rule(0.1F, 2), subdivide::VertexRule::corner);
}

double transition(std::initializer_list<std::pair<float, float>> sharpnesses) {
  subdivide::Transition sum;
  for (const auto& [before, after] : sharpnesses)
    sum.add(before, after);
  return sum.weight();
}

TEST(Transition, IsTheMeanOfSharpnessesThatJustReachedZero) {
  EXPECT_EQ(transition({}), 0.0);
  EXPECT_EQ(transition({{0.5F, 0.0F}}), 0.5);
  EXPECT_EQ(transition({{0.25F, 0.0F}, {0.75F, 0.0F}}), 0.5);
  EXPECT_EQ(transition({{0.25F, 0.0F}, {1.5F, 0.5F}, {0.0F, 0.0F}}), 0.25);
  EXPECT_EQ(transition({{1.5F, 0.5F}}), 0.0);
  EXPECT_EQ(transition({{1.5F, 0.0F}}), 1.0);  // by Chaikin's rule, clamped to 1
}

TEST(EdgeBlend, IsTheSharpnessOfAnEdgeThatBecomesSmooth) {
  EXPECT_EQ(subdivide::edge_blend(2.0F, 1.0F, 1.0F), 1.0);
  EXPECT_EQ(subdivide::edge_blend(kInfinitelySharp, kInfinitelySharp, kInfinitelySharp), 1.0);
  EXPECT_EQ(subdivide::edge_blend(0.5F, 0.0F, 0.0F), 0.5);
  EXPECT_EQ(subdivide::edge_blend(1.0F, 0.0F, 0.0F), 1.0);
  EXPECT_EQ(subdivide::edge_blend(0.0F, 0.0F, 0.0F), 0.0);
}

TEST(EdgeBlend, IsClampedWhenOneHalfDecaysSooner) {
  EXPECT_EQ(subdivide::edge_blend(1.25F, 0.25F, 0.0F), 1.0);
  EXPECT_EQ(subdivide::edge_blend(1.25F, 0.0F, 0.25F), 1.0);
  EXPECT_EQ(subdivide::edge_blend(0.75F, 0.25F, 0.0F), 0.75);
}

}  // namespace
}  // namespace mesher
