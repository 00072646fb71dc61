#include "engine/core/parallel.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstddef>
#include <stdexcept>
#include <thread>
#include <vector>

namespace mesher {
namespace {

class Parallel : public testing::TestWithParam<unsigned> {
 protected:
  ThreadLimit limit_{GetParam()};
};

INSTANTIATE_TEST_SUITE_P(Threads, Parallel, testing::Values(1U, 2U, 5U));

TEST_P(Parallel, ForVisitsEveryIndexOnce) {
  for (const std::size_t n :
       {std::size_t{0}, std::size_t{1}, std::size_t{63}, std::size_t{10'000}}) {
    std::vector<std::atomic<int>> visits(n);
    parallel_for(n, 16, [&](IndexRange range) {
      for (std::size_t i = range.begin; i < range.end; ++i)
        ++visits[i];
    });
    for (const auto& count : visits)
      EXPECT_EQ(count, 1);
  }
}

TEST_P(Parallel, ForRunsSmallRangeInOneCall) {
  std::atomic<int> calls = 0;
  parallel_for(100, 100, [&](IndexRange range) {
    ++calls;
    EXPECT_EQ(range.size(), 100U);
  });
  EXPECT_EQ(calls, 1);
}

TEST_P(Parallel, EmptyRangeCallsNothing) {
  parallel_for(0, 1, [](IndexRange) { ADD_FAILURE() << "called for an empty range"; });
  parallel_chunks(0, 1, [](std::size_t, IndexRange) { ADD_FAILURE() << "called for no chunk"; });
}

TEST_P(Parallel, ChunksDoNotDependOnThreadCount) {
  std::vector<IndexRange> ranges(chunk_count(1000, 64));
  parallel_chunks(1000, 64, [&](std::size_t i, IndexRange range) { ranges[i] = range; });
  ASSERT_EQ(ranges.size(), 16U);
  for (std::size_t i = 0; i < ranges.size(); ++i) {
    EXPECT_EQ(ranges[i].begin, i * 64);
    EXPECT_EQ(ranges[i].end, std::min<std::size_t>(1000, (i + 1) * 64));
  }
}

// The rounding of a sum of terms of very different size depends on the order of addition. Equal
// bits mean a fixed order.
TEST_P(Parallel, FloatSumIsBitwiseEqualForAnyThreadCount) {
  const auto sum = [] {
    return parallel_sum<float>(100'000, 128, [](IndexRange range) {
      float total = 0.0F;
      for (std::size_t i = range.begin; i < range.end; ++i) {
        total += std::ldexp(1.0F, static_cast<int>(i * 7919 % 40)) / static_cast<float>(i + 1);
      }
      return total;
    });
  };
  const float here = sum();
  const ThreadLimit one(1);
  EXPECT_EQ(here, sum());
}

TEST_P(Parallel, SumOfEmptyRangeIsZero) {
  EXPECT_EQ(parallel_sum<int>(0, 8, [](IndexRange) { return 1; }), 0);
}

TEST_P(Parallel, ExceptionsPropagateToCaller) {
  EXPECT_THROW(parallel_for(10'000, 1,
                            [](IndexRange range) {
                              if (range.begin <= 5000 && 5000 < range.end) {
                                throw std::runtime_error("stop");
                              }
                            }),
               std::runtime_error);
  EXPECT_THROW(parallel_chunks(10'000, 10,
                               [](std::size_t i, IndexRange) {
                                 if (i == 500) throw std::runtime_error("stop");
                               }),
               std::runtime_error);
}

TEST(ChunkCount, RoundsUp) {
  EXPECT_EQ(chunk_count(0, 4), 0U);
  EXPECT_EQ(chunk_count(1, 4), 1U);
  EXPECT_EQ(chunk_count(4, 4), 1U);
  EXPECT_EQ(chunk_count(5, 4), 2U);
}

TEST(ThreadLimit, AppliesDuringItsLifetime) {
  const unsigned before = thread_count();
  EXPECT_GE(before, 1U);
  {
    const ThreadLimit one(1);
    EXPECT_EQ(thread_count(), 1U);
    const ThreadLimit none(0);  // no limit of its own, so the outer one applies
    EXPECT_EQ(thread_count(), 1U);
  }
  EXPECT_EQ(thread_count(), before);
}

TEST(ThreadLimit, OneThreadRunsOnCallingThread) {
  const ThreadLimit one(1);
  const std::thread::id caller = std::this_thread::get_id();
  parallel_for(1000, 1, [&](IndexRange) { EXPECT_EQ(std::this_thread::get_id(), caller); });
  parallel_chunks(1000, 1,
                  [&](std::size_t, IndexRange) { EXPECT_EQ(std::this_thread::get_id(), caller); });
}

}  // namespace
}  // namespace mesher
