#include "engine/mesh/change_log.h"

#include <gtest/gtest.h>

namespace mesher {
namespace {

using Ranges = std::vector<ChangedRange>;

TEST(ChangeLog, JoinsAdjacentAndRepeatedRanges) {
  ChangeLog log;
  EXPECT_TRUE(log.is_empty());
  for (const std::uint32_t i : {5U, 6U, 6U, 7U})
    log.note(GpuArray::origin, i);
  EXPECT_EQ(log.merged(GpuArray::origin), (Ranges{{5, 8}}));
  EXPECT_TRUE(log.merged(GpuArray::position).empty());
  EXPECT_FALSE(log.is_empty());
}

TEST(ChangeLog, MergedRangesAreSortedAndDisjoint) {
  ChangeLog log;
  log.note(GpuArray::position, 20, 5);
  log.note(GpuArray::position, 3);
  log.note(GpuArray::position, 22, 10);
  log.note(GpuArray::position, 5);
  EXPECT_EQ(log.merged(GpuArray::position), (Ranges{{3, 4}, {5, 6}, {20, 32}}));
  EXPECT_EQ(log.merged(GpuArray::position, 1), (Ranges{{3, 6}, {20, 32}}));
}

TEST(ChangeLog, ClipsRangesToArraySize) {
  ChangeLog log;
  log.note(GpuArray::origin, 3, 9);
  log.note(GpuArray::origin, 20, 2);
  EXPECT_EQ(log.merged(GpuArray::origin, 0, 21), (Ranges{{3, 12}, {20, 21}}));
  EXPECT_EQ(log.merged(GpuArray::origin, 0, 20), (Ranges{{3, 12}}));
  EXPECT_EQ(log.merged(GpuArray::origin, 0, 5), (Ranges{{3, 5}}));
  EXPECT_TRUE(log.merged(GpuArray::origin, 0, 3).empty());
}

TEST(ChangeLog, EmptyRangeIsIgnored) {
  ChangeLog log;
  log.note(GpuArray::origin, 7, 0);
  EXPECT_TRUE(log.is_empty());
}

TEST(ChangeLog, TooManyRangesMarkTheWholeArray) {
  ChangeLog log;
  for (std::uint32_t i = 0; i < ChangeLog::kMaxRanges; ++i)
    log.note(GpuArray::origin, 3 * i);
  EXPECT_FALSE(log.is_whole(GpuArray::origin));
  log.note(GpuArray::origin, 1'000'000);
  EXPECT_TRUE(log.is_whole(GpuArray::origin));
  EXPECT_FALSE(log.is_whole(GpuArray::position));
  EXPECT_TRUE(log.merged(GpuArray::origin).empty());
  log.clear();
  EXPECT_TRUE(log.is_empty());
  EXPECT_FALSE(log.is_whole(GpuArray::origin));
}

}  // namespace
}  // namespace mesher
