#include "engine/simplify/collapser.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

namespace mesher::test {
namespace {

TEST(Cheapest, IsInvalidWithoutACandidate) {
  simplify::Cheapest cheapest;
  EXPECT_FALSE(cheapest.halfedge().is_valid());
  EXPECT_EQ(cheapest.cost(), simplify::kNever);
  cheapest.offer(Halfedge(3), simplify::kNever);
  EXPECT_EQ(cheapest.cost(), simplify::kNever);
}

TEST(Cheapest, EqualCostsGiveTheLowestHalfedge) {
  simplify::Cheapest cheapest;
  for (const std::uint32_t h : {9U, 4U, 7U})
    cheapest.offer(Halfedge(h), 0.0F);
  EXPECT_EQ(cheapest.halfedge(), Halfedge(4));
  EXPECT_EQ(cheapest.cost(), 0.0F);
}

TEST(Cheapest, AgreesWithComparingAllCosts) {
  std::mt19937 random(3);
  for (int round = 0; round < 1000; ++round) {
    simplify::Cheapest cheapest;
    float least = simplify::kNever;
    for (std::uint32_t h = 0; h < 12; ++h) {
      const float cost = std::ldexp(static_cast<float>(random() % 1000), int(random() % 250) - 130);
      cheapest.offer(Halfedge(h), cost);
      least = std::min(least, cost);
    }
    EXPECT_EQ(cheapest.cost(), least);
  }
}

TEST(Cheapest, NanIsNeverChosen) {
  simplify::Cheapest cheapest;
  cheapest.offer(Halfedge(1), std::numeric_limits<float>::quiet_NaN());
  EXPECT_EQ(cheapest.cost(), simplify::kNever);
}

// Data that is read together is stored together: a vertex fills one cache line, and no face crosses
// a cache line.
static_assert(sizeof(simplify::VertexState) == 64 && alignof(simplify::VertexState) == 64);
static_assert(sizeof(simplify::FaceState) == 32 && alignof(simplify::FaceState) == 32);

}  // namespace
}  // namespace mesher::test
