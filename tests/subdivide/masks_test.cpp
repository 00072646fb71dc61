#include "engine/subdivide/masks.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/vec2.hpp>
#include <numbers>
#include <numeric>
#include <vector>

namespace mesher {
namespace {

constexpr double kRounding = 1e-12;
constexpr subdivide::CreaseRules kRules[] = {subdivide::CreaseRules::hoppe94,
                                             subdivide::CreaseRules::derose98};
constexpr subdivide::VertexKind kCreaseKinds[] = {subdivide::VertexKind::regular_crease,
                                                  subdivide::VertexKind::crease};

double total(const subdivide::RingMask& mask, std::uint32_t neighbours) {
  return mask.own + neighbours * mask.each;
}

TEST(LoopMasks, SumToOneAtEveryValence) {
  for (std::uint32_t n = 3; n <= 64; ++n) {
    EXPECT_NEAR(total(subdivide::loop_vertex_mask(n), n), 1.0, kRounding) << n;
    EXPECT_NEAR(total(subdivide::loop_limit_mask(n), n), 1.0, kRounding) << n;
    EXPECT_GT(subdivide::loop_vertex_mask(n).each, 0.0) << n;
    EXPECT_GT(subdivide::loop_limit_mask(n).each, 0.0) << n;
  }
  EXPECT_EQ(2.0 * (subdivide::kLoopEdgeEnd + subdivide::kLoopEdgeOpposite), 1.0);
}

TEST(LoopMasks, MatchKnownValues) {
  EXPECT_NEAR(subdivide::loop_vertex_mask(3).own, 0.4375, kRounding);
  EXPECT_NEAR(subdivide::loop_vertex_mask(3).each, 0.1875, kRounding);
  EXPECT_NEAR(subdivide::loop_vertex_mask(4).own, 0.515625, kRounding);
  EXPECT_NEAR(subdivide::loop_vertex_mask(4).each, 0.12109375, kRounding);
  EXPECT_NEAR(subdivide::loop_vertex_mask(6).own, 0.625, kRounding);
  EXPECT_NEAR(subdivide::loop_vertex_mask(6).each, 0.0625, kRounding);
  EXPECT_NEAR(subdivide::loop_limit_mask(3).own, 0.4, kRounding);
  EXPECT_NEAR(subdivide::loop_limit_mask(4).own, 24.0 / 55.0, kRounding);
  EXPECT_NEAR(subdivide::loop_limit_mask(6).own, 0.5, kRounding);
  EXPECT_NEAR(subdivide::loop_limit_mask(6).each, 1.0 / 12.0, kRounding);
}

/// One level mixes 3/8 of a neighbor's position into the vertex, so the limit mask must be
/// invariant.
TEST(LoopMasks, LimitIsInvariantUnderOneLevel) {
  for (std::uint32_t n = 3; n <= 64; ++n) {
    const subdivide::RingMask limit = subdivide::loop_limit_mask(n);
    const double after =
        limit.own * subdivide::loop_vertex_mask(n).own + n * limit.each * subdivide::kLoopEdgeEnd;
    EXPECT_NEAR(after, limit.own, kRounding) << n;
  }
}

TEST(CreaseMasks, SumToOneAndLimitIsInvariantUnderOneLevel) {
  EXPECT_EQ(total(subdivide::kCreaseVertexMask, 2), 1.0);
  for (const subdivide::CreaseRules rules : kRules) {
    for (const subdivide::VertexKind kind : kCreaseKinds) {
      const subdivide::RingMask limit = subdivide::crease_limit_mask(rules, kind);
      EXPECT_NEAR(total(limit, 2), 1.0, kRounding);
      // From the next level on, both neighbors are edge vertices, which are regular.
      const double of_vertex =
          subdivide::sharp_edge_weight(rules, kind, subdivide::VertexKind::regular_crease);
      const double after =
          limit.own * subdivide::kCreaseVertexMask.own + 2.0 * limit.each * of_vertex;
      EXPECT_NEAR(after, limit.own, kRounding);
    }
  }
  EXPECT_NEAR(
      subdivide::crease_limit_mask(subdivide::CreaseRules::hoppe94, subdivide::VertexKind::crease)
          .own,
      0.6, kRounding);
}

/// The weight of the first end by H. Hoppe et al., 1994, table 1. 0: the smooth mask.
struct TableRow {
  subdivide::VertexKind first;
  double at_dart, at_regular, at_crease, at_corner;
};

TEST(SharpEdgeMasks, MatchTheTableOfHoppe) {
  constexpr TableRow kTable[] = {
      {subdivide::VertexKind::dart, 0.0, 0.0, 0.0, 0.0},
      {subdivide::VertexKind::regular_crease, 0.0, 4.0 / 8, 5.0 / 8, 5.0 / 8},
      {subdivide::VertexKind::crease, 0.0, 3.0 / 8, 4.0 / 8, 4.0 / 8},
      {subdivide::VertexKind::corner, 0.0, 3.0 / 8, 4.0 / 8, 4.0 / 8},
  };
  constexpr subdivide::VertexKind kSecond[] = {
      subdivide::VertexKind::dart, subdivide::VertexKind::regular_crease,
      subdivide::VertexKind::crease, subdivide::VertexKind::corner};
  for (const TableRow& row : kTable) {
    const double expected[] = {row.at_dart, row.at_regular, row.at_crease, row.at_corner};
    for (std::size_t i = 0; i < 4; ++i) {
      SCOPED_TRACE(std::to_string(int(row.first)) + ' ' + std::to_string(int(kSecond[i])));
      const bool is_sharp =
          subdivide::has_sharp_mask(subdivide::CreaseRules::hoppe94, row.first, kSecond[i]);
      EXPECT_EQ(is_sharp, expected[i] > 0.0);
      if (!is_sharp) continue;
      EXPECT_EQ(
          subdivide::sharp_edge_weight(subdivide::CreaseRules::hoppe94, row.first, kSecond[i]),
          expected[i]);
      EXPECT_EQ(
          subdivide::sharp_edge_weight(subdivide::CreaseRules::hoppe94, kSecond[i], row.first),
          1.0 - expected[i]);
    }
  }
}

TEST(SharpEdgeMasks, DeRoseUsesMidpointsEvenAtDarts) {
  constexpr subdivide::VertexKind kEnds[] = {
      subdivide::VertexKind::dart, subdivide::VertexKind::regular_crease,
      subdivide::VertexKind::crease, subdivide::VertexKind::corner};
  for (const subdivide::VertexKind first : kEnds) {
    for (const subdivide::VertexKind second : kEnds) {
      EXPECT_TRUE(subdivide::has_sharp_mask(subdivide::CreaseRules::derose98, first, second));
      EXPECT_EQ(subdivide::sharp_edge_weight(subdivide::CreaseRules::derose98, first, second), 0.5);
    }
  }
}

/// Weights of a vertex and of its neighbors on one side of a crease.
struct Tangent {
  double own = 0.0;
  std::vector<double> of;
};

Tangent tangent(subdivide::CreaseRules rules, subdivide::VertexKind kind, std::size_t n) {
  Tangent t;
  t.of.resize(n, std::nan(""));
  t.own = subdivide::across_crease_tangent(rules, kind, t.of);
  return t;
}

template <class Check>
void for_each_tangent(const Check& check) {
  for (const subdivide::CreaseRules rules : kRules) {
    for (const subdivide::VertexKind kind : kCreaseKinds) {
      for (std::size_t n = 2; n <= 12; ++n) {
        SCOPED_TRACE("rules " + std::to_string(int(rules)) + ", kind " + std::to_string(int(kind)) +
                     ", " + std::to_string(n) + " neighbors");
        check(rules, kind, tangent(rules, kind, n));
      }
    }
  }
}

TEST(AcrossCreaseTangent, IsZeroWhenAllPointsCoincide) {
  for_each_tangent([](subdivide::CreaseRules, subdivide::VertexKind, const Tangent& t) {
    EXPECT_NEAR(std::accumulate(t.of.begin(), t.of.end(), t.own), 0.0, kRounding);
  });
}

TEST(AcrossCreaseTangent, PointsToItsSideAndNotAlongTheCrease) {
  for_each_tangent([](subdivide::CreaseRules, subdivide::VertexKind, const Tangent& t) {
    // Slightly less than half a disc. With two neighbors, a full half disc would have no side.
    constexpr double kGap = 0.05 * std::numbers::pi;
    const double step = (std::numbers::pi - 2.0 * kGap) / static_cast<double>(t.of.size() - 1);
    glm::dvec2 sum(0.0);
    for (std::size_t i = 0; i < t.of.size(); ++i) {
      const double angle = kGap + static_cast<double>(i) * step;
      sum += t.of[i] * glm::dvec2(std::cos(angle), std::sin(angle));
    }
    EXPECT_GT(sum.y, 0.0);
    EXPECT_NEAR(sum.x, 0.0, kRounding);
  });
}

/// Applies one level of subdivision to a linear form on a crease vertex and its side.
Tangent stepped(const Tangent& t, double edge_weight_of_vertex) {
  const std::size_t last = t.of.size() - 1;
  Tangent after{t.own * subdivide::kCreaseVertexMask.own, std::vector<double>(last + 1, 0.0)};
  for (const std::size_t end : {std::size_t{0}, last}) {
    after.of[end] += t.own * subdivide::kCreaseVertexMask.each;
    after.own += t.of[end] * edge_weight_of_vertex;
    after.of[end] += t.of[end] * (1.0 - edge_weight_of_vertex);
  }
  for (std::size_t i = 1; i < last; ++i) {
    after.own += t.of[i] * subdivide::kLoopEdgeEnd;
    after.of[i] += t.of[i] * subdivide::kLoopEdgeEnd;
    after.of[i - 1] += t.of[i] * subdivide::kLoopEdgeOpposite;
    after.of[i + 1] += t.of[i] * subdivide::kLoopEdgeOpposite;
  }
  return after;
}

TEST(AcrossCreaseTangent, KeepsItsDirectionUnderOneLevel) {
  for_each_tangent([](subdivide::CreaseRules rules, subdivide::VertexKind kind, const Tangent& t) {
    const double weight =
        subdivide::sharp_edge_weight(rules, kind, subdivide::VertexKind::regular_crease);
    const Tangent after = stepped(t, weight);
    const double shrinks = after.of[1] / t.of[1];
    EXPECT_GT(shrinks, 0.0);
    EXPECT_LT(shrinks, 1.0);
    EXPECT_NEAR(after.own, shrinks * t.own, kRounding);
    for (std::size_t i = 0; i < t.of.size(); ++i)
      EXPECT_NEAR(after.of[i], shrinks * t.of[i], kRounding) << i;
  });
}

TEST(AcrossCreaseTangent, MatchesKnownValues) {
  const Tangent regular =
      tangent(subdivide::CreaseRules::hoppe94, subdivide::VertexKind::regular_crease, 4);
  EXPECT_NEAR(regular.own, -2.0, kRounding);
  const double by_hand[] = {-1.0, 2.0, 2.0, -1.0};
  for (std::size_t i = 0; i < 4; ++i)
    EXPECT_NEAR(regular.of[i], by_hand[i], kRounding);
  const Tangent three = tangent(subdivide::CreaseRules::derose98, subdivide::VertexKind::crease, 3);
  EXPECT_EQ(three.own, -1.0);
  EXPECT_EQ(three.of, (std::vector<double>{0.0, 1.0, 0.0}));
  const Tangent two = tangent(subdivide::CreaseRules::hoppe94, subdivide::VertexKind::crease, 2);
  EXPECT_EQ(two.own, -2.0);
  EXPECT_EQ(two.of, (std::vector<double>{1.0, 1.0}));
}

TEST(ButterflyMasks, SumToOne) {
  EXPECT_EQ(2.0 * (subdivide::kButterflyEnd + subdivide::kButterflyOpposite) +
                4.0 * subdivide::kButterflyWing,
            1.0);
  EXPECT_EQ(2.0 * (subdivide::kFourPointEnd + subdivide::kFourPointNext), 1.0);
  for (std::uint32_t n = 3; n <= 64; ++n) {
    double ring = 0.0;
    for (std::uint32_t i = 0; i < n; ++i)
      ring += subdivide::butterfly_ring_weight(n, i);
    EXPECT_NEAR(ring, 0.25, kRounding) << n;
    EXPECT_NEAR(subdivide::kButterflyCenter + ring, 1.0, kRounding) << n;
  }
}

TEST(ButterflyMasks, MatchKnownValuesAndAreSymmetric) {
  EXPECT_EQ(subdivide::butterfly_ring_weight(3, 0), 5.0 / 12.0);
  EXPECT_EQ(subdivide::butterfly_ring_weight(3, 2), -1.0 / 12.0);
  EXPECT_EQ(subdivide::butterfly_ring_weight(4, 0), 3.0 / 8.0);
  EXPECT_EQ(subdivide::butterfly_ring_weight(4, 1), 0.0);
  EXPECT_EQ(subdivide::butterfly_ring_weight(4, 2), -1.0 / 8.0);
  EXPECT_NEAR(subdivide::butterfly_ring_weight(5, 0), 1.75 / 5.0, kRounding);
  EXPECT_NEAR(subdivide::butterfly_ring_weight(8, 4), -0.25 / 8.0, kRounding);
  for (std::uint32_t n = 3; n <= 64; ++n) {
    for (std::uint32_t i = 1; i < n; ++i)
      EXPECT_NEAR(subdivide::butterfly_ring_weight(n, i),
                  subdivide::butterfly_ring_weight(n, n - i), kRounding);
  }
}

}  // namespace
}  // namespace mesher
