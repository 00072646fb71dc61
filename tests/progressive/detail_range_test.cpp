#include "engine/progressive/detail_range.h"

#include <gtest/gtest.h>

namespace mesher {
namespace {

TEST(DetailRange, TimeAndPositionAreMonotonicAndInvertible) {
  for (const double geomorph_range : {0.0, 0.01, 0.125, 0.5}) {
    const progressive::DetailRange range{
        .base_vertices = 102.0, .splits = 40'000, .geomorph_range = geomorph_range};
    double grown = -1e9;
    double last_time = -1.0;
    for (int i = 0; i <= 1000; ++i) {
      const double position = i / 1000.0;
      const double time = range.time_at(position);
      EXPECT_NEAR(range.position_of(time), position, 1e-9);
      EXPECT_GT(time, last_time);
      EXPECT_GE(range.growing(time), 1.0);
      EXPECT_GT(range.grown(time), grown);
      grown = range.grown(time);
      last_time = time;
      EXPECT_NEAR(range.time_of(grown), time, 1e-6 * (1.0 + time))
          << geomorph_range << " " << position;
    }
    EXPECT_NEAR(range.grown(range.end()), 40'000, 1e-6);
    EXPECT_EQ(range.level(range.end()), 40'000U);
    EXPECT_EQ(range.level(0.0), 0U);
    EXPECT_EQ(range.growth(range.end()), GeomorphTime::done());
  }
}

TEST(DetailRange, AllSplitsOfALevelAreGrownAtItsTime) {
  const progressive::DetailRange range{
      .base_vertices = 50.0, .splits = 1000, .geomorph_range = 0.25};
  EXPECT_EQ(range.time_of_level(0), 0.0);
  for (const std::uint32_t level : {1U, 2U, 17U, 500U, 999U}) {
    const double time = range.time_of_level(level);
    const GeomorphTime growth = range.growth(time);
    EXPECT_NEAR(mesher::growth(growth, level - 1), 1.0, 1e-4) << level;
    EXPECT_LT(mesher::growth(growth, level), 1.0) << level;
    EXPECT_GE(range.level(time), level);
  }
}

TEST(DetailRange, EverySplitGrowsContinuouslyAndNeverShrinks) {
  const progressive::DetailRange range{.base_vertices = 20.0, .splits = 300, .geomorph_range = 0.2};
  for (const std::uint32_t split : {0U, 5U, 100U, 299U}) {
    float last = 0.0F;
    for (double time = 0.0; time <= range.end(); time += 0.01) {
      if (range.level(time) <= split) continue;  // the split is not in the mesh yet
      const float now = mesher::growth(range.growth(time), split);
      EXPECT_GE(now, last - 1e-5F);
      EXPECT_LE(now, last + 0.02F) << split << " at " << time;
      last = now;
    }
    EXPECT_EQ(mesher::growth(range.growth(range.end()), split), 1.0F);
  }
}

TEST(DetailRange, WithoutGeomorphRangeSplitsPop) {
  const progressive::DetailRange range{.base_vertices = 10.0, .splits = 20, .geomorph_range = 0.0};
  EXPECT_EQ(range.end(), 20.0);
  EXPECT_EQ(range.time_of_level(7), 7.0);
  EXPECT_EQ(range.level(7.0), 7U);
  EXPECT_EQ(range.level(7.5), 8U);
  EXPECT_EQ(range.growth(7.5), GeomorphTime::done());
}

TEST(DetailRange, WithoutSplitsIsAlwaysAtTheEnd) {
  const progressive::DetailRange range{.base_vertices = 10.0, .splits = 0, .geomorph_range = 0.3};
  EXPECT_EQ(range.end(), 0.0);
  EXPECT_EQ(range.position_of(0.0), 1.0);
  EXPECT_EQ(range.time_at(0.3), 0.0);
  EXPECT_EQ(range.level(0.0), 0U);
}

}  // namespace
}  // namespace mesher
