#include "engine/subdivide/sharp_masks.h"

#include <gtest/gtest.h>

#include <vector>

#include "engine/subdivide/sharpness.h"

namespace mesher {
namespace {

using Point = glm::dvec3;

constexpr Point kVertex(8, 0, 0);
constexpr Point kSmooth(0, 0, 64);
constexpr Point kA(0, 16, 0);
constexpr Point kB(0, 0, 32);
constexpr Point kC(0, 64, 0);

Point on_crease(const Point& a, const Point& b) {
  return 0.75 * kVertex + 0.125 * (a + b);
}

Point moved(float own, const std::vector<subdivide::SharpSpoke>& spokes) {
  return subdivide::sharp_vertex_point(kVertex, own, spokes, kSmooth);
}

void expect_near(const Point& is, const Point& expected) {
  for (int i = 0; i < 3; ++i)
    EXPECT_NEAR(is[i], expected[i], 1e-6) << "coordinate " << i;
}

TEST(SharpVertexPoint, DependsOnTheNumberOfSharpEdges) {
  constexpr float kSharp = kInfinitelySharp;
  expect_near(moved(0.0F, {}), kSmooth);
  expect_near(moved(0.0F, {{kA, kSharp, kSharp}}), kSmooth);
  expect_near(moved(0.0F, {{kA, kSharp, kSharp}, {kB, kSharp, kSharp}}), on_crease(kA, kB));
  expect_near(moved(0.0F, {{kA, kSharp, kSharp}, {kB, kSharp, kSharp}, {kC, kSharp, kSharp}}),
              kVertex);
  expect_near(moved(kSharp, {}), kVertex);
  expect_near(moved(kSharp, {{kA, kSharp, kSharp}, {kB, kSharp, kSharp}}), kVertex);
}

TEST(SharpVertexPoint, IsFullySharpWhileSharpnessRemains) {
  expect_near(moved(0.0F, {{kA, 1.25F, 0.25F}, {kB, 1.5F, 0.5F}}), on_crease(kA, kB));
  expect_near(moved(1.5F, {}), kVertex);
}

TEST(SharpVertexPoint, BlendsWhenACreaseDecaysToZero) {
  expect_near(moved(0.0F, {{kA, 0.25F, 0.0F}, {kB, 0.75F, 0.0F}}),
              0.5 * on_crease(kA, kB) + 0.5 * kSmooth);
  // One of the two edges becomes smooth, which leaves a dart.
  expect_near(moved(0.0F, {{kA, 0.25F, 0.0F}, {kB, 2.0F, 1.0F}}),
              0.25 * on_crease(kA, kB) + 0.75 * kSmooth);
}

TEST(SharpVertexPoint, BlendsACornerWithTheRemainingCrease) {
  expect_near(moved(0.0F, {{kA, 2.0F, 1.0F}, {kC, 0.25F, 0.0F}, {kB, 2.0F, 1.0F}}),
              0.25 * kVertex + 0.75 * on_crease(kA, kB));
  expect_near(moved(0.5F, {{kA, 2.0F, 1.0F}, {kB, 2.0F, 1.0F}}),
              0.5 * kVertex + 0.5 * on_crease(kA, kB));
  expect_near(moved(0.25F, {}), 0.25 * kVertex + 0.75 * kSmooth);
}

TEST(SharpVertexPoint, DoesNotBlendWhenTheRuleIsUnchanged) {
  // The vertex is a corner with four sharp edges and with three, so the rule does not change.
  expect_near(
      moved(0.0F, {{kA, 2.0F, 1.0F}, {kB, 2.0F, 1.0F}, {kC, 2.0F, 1.0F}, {kSmooth, 0.25F, 0.0F}}),
      kVertex);
}

subdivide::SharpSpan edge(subdivide::VertexKind first, subdivide::VertexKind second,
                          float sharpness, float left) {
  return {.end = {kA, kB}, .kind = {first, second}, .sharpness = sharpness, .left = {left, left}};
}

TEST(SharpEdgePoint, IsCloserToTheRegularEnd) {
  const auto at = [](subdivide::CreaseRules rules, subdivide::VertexKind first,
                     subdivide::VertexKind second) {
    return subdivide::sharp_edge_point(
        rules, edge(first, second, kInfinitelySharp, kInfinitelySharp), kSmooth);
  };
  constexpr auto kRegular = subdivide::VertexKind::regular_crease;
  constexpr auto kCorner = subdivide::VertexKind::corner;
  expect_near(at(subdivide::CreaseRules::hoppe94, kRegular, kCorner), 0.625 * kA + 0.375 * kB);
  expect_near(at(subdivide::CreaseRules::hoppe94, kCorner, kRegular), 0.375 * kA + 0.625 * kB);
  expect_near(at(subdivide::CreaseRules::hoppe94, kCorner, kCorner), 0.5 * (kA + kB));
  expect_near(at(subdivide::CreaseRules::derose98, kRegular, kCorner), 0.5 * (kA + kB));
}

TEST(SharpEdgePoint, IsSmoothAtDartsOfHoppe) {
  const subdivide::SharpSpan span = edge(subdivide::VertexKind::dart, subdivide::VertexKind::corner,
                                         kInfinitelySharp, kInfinitelySharp);
  expect_near(subdivide::sharp_edge_point(subdivide::CreaseRules::hoppe94, span, kSmooth), kSmooth);
  expect_near(subdivide::sharp_edge_point(subdivide::CreaseRules::derose98, span, kSmooth),
              0.5 * (kA + kB));
}

TEST(SharpEdgePoint, BlendsWhenTheEdgeBecomesSmooth) {
  const auto at = [](float sharpness, std::array<float, 2> left) {
    subdivide::SharpSpan span =
        edge(subdivide::VertexKind::crease, subdivide::VertexKind::crease, sharpness, 0.0F);
    span.left = left;
    return subdivide::sharp_edge_point(subdivide::CreaseRules::derose98, span, kSmooth);
  };
  const Point middle = 0.5 * (kA + kB);
  expect_near(at(0.25F, {0.0F, 0.0F}), 0.25 * middle + 0.75 * kSmooth);
  expect_near(at(1.5F, {0.5F, 0.5F}), middle);
  expect_near(at(1.25F, {0.25F, 0.0F}), middle);  // clamped
}

}  // namespace
}  // namespace mesher
