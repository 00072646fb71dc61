#include "engine/mesh/geomorph.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>

#include "engine/mesh/packed_normal.h"

namespace mesher {
namespace {

const glm::vec3 kX(1, 0, 0);
const glm::vec3 kY(0, 1, 0);
const glm::vec3 kZ(0, 0, 1);

/// A vertex at 0 that splits three times. Split 0 moves it to (1, 0, 0). Split 1 belongs to another
/// vertex. Split 2 creates its child at (1, 1, 0) and does not move the parent.
std::array<SplitMorph, 3> three_splits() {
  const std::uint32_t x = encode_normal(kX);
  const std::uint32_t y = encode_normal(kY);
  const std::uint32_t z = encode_normal(kZ);
  return {{{kX, kNoHead, -kX, z, x, z},
           {kZ, kNoHead, kZ, z, z, z},
           {glm::vec3(0.0F), 2 * 0, kY, x, x, y}}};
}
constexpr std::uint32_t kParentHead = 2 * 2;
constexpr std::uint32_t kChildHead = 2 * 2 + 1;

TEST(Geomorph, DoneTimeReturnsTheMeshUnchanged) {
  const auto splits = three_splits();
  const glm::vec3 p(1, 1, 0);
  EXPECT_EQ(morphed_position(p, kChildHead, splits, GeomorphTime::done()), p);
  EXPECT_EQ(morphed_normal(encode_normal(kY), kChildHead, splits, GeomorphTime::done()), kY);
  EXPECT_EQ(growth(GeomorphTime::done(), 5), 1.0F);
}

TEST(Geomorph, AllSplitsBetweenTwoLevelsGrowEqually) {
  const auto splits = three_splits();
  for (const float alpha : {0.0F, 0.25F, 0.5F, 1.0F}) {
    const GeomorphTime time = GeomorphTime::between(0, alpha);
    EXPECT_EQ(growth(time, 0), alpha);
    EXPECT_EQ(growth(time, 2), alpha);
    EXPECT_EQ(morphed_position({1, 1, 0}, kChildHead, splits, time), alpha * glm::vec3(1, 1, 0));
    EXPECT_EQ(morphed_position({1, 0, 0}, kParentHead, splits, time), alpha * kX);
  }
}

TEST(Geomorph, SplitsBeforeTheFirstGrowingOneAreDone) {
  const auto splits = three_splits();
  const GeomorphTime time = GeomorphTime::between(1, 0.0F);
  EXPECT_EQ(growth(time, 0), 1.0F);
  EXPECT_EQ(morphed_position({1, 1, 0}, kChildHead, splits, time), kX)
      << "a child starts at its parent";
}

TEST(Geomorph, VertexWithoutSplitsDoesNotMove) {
  EXPECT_EQ(morphed_position(kY, kNoHead, three_splits(), GeomorphTime::between(0, 0.0F)), kY);
  EXPECT_EQ(
      morphed_normal(encode_normal(kY), kNoHead, three_splits(), GeomorphTime::between(0, 0.0F)),
      kY);
}

TEST(Geomorph, NormalsInterpolateAndStayUnitLength) {
  const auto splits = three_splits();
  const std::uint32_t y = encode_normal(kY);
  EXPECT_EQ(morphed_normal(y, kChildHead, splits, GeomorphTime::between(0, 0.0F)), kZ);
  EXPECT_EQ(morphed_normal(y, kChildHead, splits, GeomorphTime::between(1, 0.0F)), kX);
  const glm::vec3 half = morphed_normal(y, kChildHead, splits, GeomorphTime::between(1, 0.5F));
  EXPECT_NEAR(glm::length(half - glm::normalize(kX + kY)), 0.0F, 1e-6F);
}

TEST(Geomorph, OppositeNormalsKeepTheFineNormalHalfway) {
  const std::array<SplitMorph, 1> splits{
      {{kX, kNoHead, kX, encode_normal(-kZ), encode_normal(kZ), encode_normal(kZ)}}};
  EXPECT_EQ(morphed_normal(encode_normal(kZ), 0, splits, GeomorphTime::between(0, 0.5F)), kZ);
}

TEST(Geomorph, ContinuousTimeGrowsEachSplitOverTheGeomorphRange) {
  constexpr std::uint32_t kSplits = 1000;
  for (const double range : {1.0, 0.3, 7.0, 100.0, 333.3}) {
    for (double time = 0.0; time < kSplits + range + 5; time += 0.37) {
      const GeomorphTime at = GeomorphTime::continuous(time, range);
      for (std::uint32_t i = 0; i < kSplits; i += 3) {
        const double expected = std::clamp((time - i) / range, 0.0, 1.0);
        ASSERT_NEAR(growth(at, i), expected, 1e-4) << time << " " << range << " " << i;
        if (i < at.first_growing) {
          ASSERT_EQ(expected, 1.0) << time << " " << range << " " << i;
        }
      }
    }
  }
}

TEST(Geomorph, ContinuousTimeStartsWithNoSplitsAndEndsWithAll) {
  const GeomorphTime begin = GeomorphTime::continuous(0.0, 50.0);
  EXPECT_EQ(begin.first_growing, 0U);
  EXPECT_EQ(growth(begin, 0), 0.0F);
  const GeomorphTime end = GeomorphTime::continuous(1050.0, 50.0);
  EXPECT_EQ(end.first_growing, 1000U);
  EXPECT_EQ(growth(end, 999), 1.0F);
  const GeomorphTime late = GeomorphTime::continuous(1e300, 1e-3);
  EXPECT_EQ(growth(late, 1'000'000'000U), 1.0F);
}

TEST(Geomorph, ContinuousTimeIsPreciseForMillionsOfSplits) {
  // Near 100 million the spacing of floats is 8. The difference has to be exact, not the time.
  const double base = 100'000'000.0;
  float before = 0.0F;
  for (int step = 1; step <= 100; ++step) {
    const float grown = growth(GeomorphTime::continuous(base + 0.01 * step, 1.0), 100'000'000U);
    EXPECT_NEAR(grown - before, 0.01F, 1e-5F);
    before = grown;
  }
}

}  // namespace
}  // namespace mesher
