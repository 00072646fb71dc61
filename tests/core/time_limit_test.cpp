#include "engine/core/time_limit.h"

#include <gtest/gtest.h>

#include "engine/core/error.h"
#include "engine/core/parallel.h"
#include "engine/core/progress.h"

namespace mesher {
namespace {

using namespace std::chrono_literals;

void wait_for_end() {
  while (!TimeLimit::is_over())
    std::this_thread::sleep_for(1ms);
}

TEST(TimeLimit, CancelsEveryOperation) {
  Progress progress;
  const TimeLimit limit(0.02, 1h);
  wait_for_end();
  EXPECT_TRUE(progress.is_cancelled());
  EXPECT_THROW(report(&progress, 0.5F), Cancelled);
  EXPECT_THROW(progress.seal(), Cancelled);
  Progress made_later;
  EXPECT_THROW(check_cancelled(&made_later), Cancelled);
}

TEST(TimeLimit, CancelsOperationsWithoutProgress) {
  const TimeLimit limit(0.02, 1h);
  wait_for_end();
  EXPECT_THROW(check_cancelled(nullptr), Cancelled);
  EXPECT_THROW(report(nullptr, 0.5F), Cancelled);
  EXPECT_THROW(begin_stage(nullptr, "working"), Cancelled);
  EXPECT_THROW(seal(nullptr), Cancelled);
  EXPECT_THROW(parallel_chunks(10, 1, nullptr, [](std::size_t, IndexRange) {}), Cancelled);
}

TEST(TimeLimit, SealedOperationIsFinished) {
  Progress progress;
  const TimeLimit limit(0.05, 1h);
  progress.seal();
  wait_for_end();
  EXPECT_FALSE(progress.is_cancelled());
  EXPECT_NO_THROW(check_cancelled(&progress));
}

TEST(TimeLimit, NothingIsOverWithoutOneOrAfterIt) {
  {
    const TimeLimit none(0.0);
    EXPECT_FALSE(TimeLimit::is_over());
    EXPECT_NO_THROW(check_cancelled(nullptr));
  }
  {
    const TimeLimit limit(0.01, 1h);
    wait_for_end();
  }
  EXPECT_FALSE(TimeLimit::is_over());
  EXPECT_NO_THROW(check_cancelled(nullptr));
}

// A loop that never looks at its progress.
TEST(TimeLimitDeathTest, EndsWhatDoesNotLookAfterTheGracePeriod) {
  EXPECT_EXIT(
      {
        const TimeLimit limit(0.02, 20ms);
        for (;;)
          std::this_thread::sleep_for(1ms);
      },
      testing::ExitedWithCode(static_cast<int>(ExitCode::timed_out)),
      "mesher: stopped after 20 ms \\(--timeout\\)");
}

}  // namespace
}  // namespace mesher
