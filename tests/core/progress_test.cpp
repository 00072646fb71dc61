#include "engine/core/progress.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <thread>
#include <vector>

#include "engine/core/error.h"
#include "engine/core/parallel.h"

namespace mesher {
namespace {

TEST(Progress, StoresStageAndFraction) {
  Progress progress;
  EXPECT_EQ(progress.stage(), "");
  begin_stage(&progress, "reading");
  report(&progress, 0.5F);
  EXPECT_EQ(progress.stage(), "reading");
  EXPECT_EQ(progress.fraction(), 0.5F);
}

TEST(Progress, NeverFalls) {
  Progress progress;
  report(&progress, 0.9F);
  report(&progress, 0.2F);
  begin_stage(&progress, "building");
  EXPECT_EQ(progress.stage(), "building");
  EXPECT_EQ(progress.fraction(), 0.9F);
}

TEST(Progress, IgnoresFractionsOutsideOfTheStage) {
  Progress progress;
  Stages stages(&progress, {1.0, 1.0});
  stages.next();
  report(&progress, -1.0F);
  EXPECT_EQ(progress.fraction(), 0.0F);
  report(&progress, 7.0F);
  EXPECT_EQ(progress.fraction(), 0.5F);
  report(&progress, 0.0F / 0.0F);
  EXPECT_EQ(progress.fraction(), 0.5F);
}

TEST(Progress, NullProgressIsIgnored) {
  EXPECT_NO_THROW(begin_stage(nullptr, "reading"));
  EXPECT_NO_THROW(report(nullptr, 0.5F));
  EXPECT_NO_THROW(check_cancelled(nullptr));
  Stages stages(nullptr, {1.0});
  EXPECT_NO_THROW(stages.next("reading"));
  OpenStages rounds(nullptr);
  EXPECT_NO_THROW(rounds.next());
}

TEST(Progress, CancelThrowsAtNextReport) {
  Progress progress;
  begin_stage(&progress, "reading");
  EXPECT_FALSE(progress.is_cancelled());
  progress.cancel();
  EXPECT_TRUE(progress.is_cancelled());
  EXPECT_THROW(report(&progress, 0.5F), Cancelled);
  EXPECT_THROW(check_cancelled(&progress), Cancelled);
  EXPECT_THROW(begin_stage(&progress, "building"), Cancelled);
  EXPECT_EQ(progress.stage(), "reading");
  EXPECT_EQ(progress.fraction(), 0.0F);
}

TEST(Progress, IsCancelledOrSealedWhicheverComesFirst) {
  Progress cancelled;
  EXPECT_TRUE(cancelled.cancel());
  EXPECT_TRUE(cancelled.cancel());
  EXPECT_THROW(seal(&cancelled), Cancelled);
  Progress sealed;
  seal(&sealed);
  EXPECT_FALSE(sealed.cancel());
  EXPECT_FALSE(sealed.is_cancelled());
  EXPECT_NO_THROW(report(&sealed, 1.0F));
  EXPECT_NO_THROW(seal(&sealed));
  EXPECT_NO_THROW(seal(nullptr));
}

TEST(Progress, CancelWorksFromAnotherThread) {
  Progress progress;
  bool was_cancelled = false;
  std::thread worker([&] {
    try {
      for (;;)
        report(&progress, 0.1F);
    } catch (const Cancelled&) {
      was_cancelled = true;
    }
  });
  progress.cancel();
  worker.join();
  EXPECT_TRUE(was_cancelled);
}

TEST(Progress, RisesWhileSeveralThreadsReport) {
  Progress progress;
  std::atomic<bool> is_done{false};
  std::vector<float> seen;
  std::thread watcher([&] {
    while (!is_done)
      seen.push_back(progress.fraction());
  });
  std::vector<std::thread> workers;
  for (int k = 0; k < 4; ++k) {
    workers.emplace_back([&progress, k] {
      for (int i = k; i < 40'000; i += 4)
        report(&progress, static_cast<float>(i) / 40'000.0F);
    });
  }
  for (std::thread& worker : workers)
    worker.join();
  is_done = true;
  watcher.join();
  EXPECT_TRUE(std::ranges::is_sorted(seen));
  EXPECT_EQ(progress.fraction(), 39'999.0F / 40'000.0F);
}

TEST(Stages, FillTheWholeInProportionToTheirWeights) {
  Progress progress;
  {
    Stages stages(&progress, {6.0, 2.0});
    stages.next("reading");
    report(&progress, 0.5F);
    EXPECT_EQ(progress.fraction(), 0.375F);
    stages.next("building");
    EXPECT_EQ(progress.fraction(), 0.75F) << "the first stage is finished";
    EXPECT_EQ(progress.stage(), "building");
    report(&progress, 0.5F);
    EXPECT_EQ(progress.fraction(), 0.875F);
  }
  EXPECT_EQ(progress.fraction(), 1.0F);
}

TEST(Stages, NestWithinTheCurrentStage) {
  Progress progress;
  Stages outer(&progress, {1.0, 1.0});
  outer.next("outer");
  {
    Stages inner(&progress, {1.0, 3.0});
    inner.next();
    EXPECT_EQ(progress.stage(), "outer") << "an empty name keeps the text";
    inner.next("inner");
    EXPECT_EQ(progress.fraction(), 0.125F);
    report(&progress, 0.5F);
    EXPECT_EQ(progress.fraction(), 0.3125F);
  }
  EXPECT_EQ(progress.fraction(), 0.5F) << "the inner stages end where the outer one does";
  outer.next();
  report(&progress, 0.5F);
  EXPECT_EQ(progress.fraction(), 0.75F);
}

TEST(Stages, UnusedStagesAreFinishedAtTheEnd) {
  Progress progress;
  {
    Stages stages(&progress, {1.0, 1.0, 0.0, 2.0});
    stages.next();
    stages.next();
  }
  EXPECT_EQ(progress.fraction(), 1.0F);
}

TEST(Stages, WithoutWeightStillReachTheEnd) {
  Progress progress;
  {
    Stages stages(&progress, {0.0, 0.0});
    stages.next();
    stages.next();
    report(&progress, 0.5F);
  }
  EXPECT_EQ(progress.fraction(), 1.0F);
}

TEST(Stages, ExceptionLeavesTheFraction) {
  Progress progress;
  const auto fail = [&] {
    Stages stages(&progress, {1.0, 1.0});
    stages.next();
    report(&progress, 0.5F);
    throw InputError("no");
  };
  EXPECT_THROW(fail(), InputError);
  EXPECT_EQ(progress.fraction(), 0.25F) << "what failed is not finished";
  report(&progress, 0.5F);
  EXPECT_EQ(progress.fraction(), 0.5F) << "the whole is the current stage again";
}

TEST(Stages, NextThrowsWhenCanceled) {
  Progress progress;
  Stages stages(&progress, {1.0, 1.0});
  stages.next("first");
  progress.cancel();
  EXPECT_THROW(stages.next("second"), Cancelled);
  EXPECT_EQ(progress.stage(), "first");
}

TEST(OpenStages, FillAShareOfTheRest) {
  Progress progress;
  {
    OpenStages rounds(&progress, 0.5);
    rounds.next();
    report(&progress, 1.0F);
    EXPECT_EQ(progress.fraction(), 0.5F);
    rounds.next();
    report(&progress, 0.5F);
    EXPECT_EQ(progress.fraction(), 0.625F);
    for (int i = 0; i < 10; ++i)
      rounds.next();
    EXPECT_LT(progress.fraction(), 1.0F);
  }
  EXPECT_EQ(progress.fraction(), 1.0F);
}

TEST(Stages, ParallelChunksReportFinishedWorkOnly) {
  constexpr std::size_t kChunks = 64;
  Progress progress;
  std::atomic<std::size_t> finished{0};
  std::atomic<bool> overstates{false};
  parallel_chunks(kChunks, 1, &progress, [&](std::size_t, IndexRange) {
    // Chunks may run in any order: the middle one is no sign that half of the work is done.
    const float fraction = progress.fraction();
    if (fraction > static_cast<float>(finished) / kChunks + 1e-6F) overstates = true;
    std::this_thread::sleep_for(std::chrono::microseconds(200));
    ++finished;
  });
  EXPECT_FALSE(overstates);
  EXPECT_EQ(progress.fraction(), 1.0F);
}

TEST(Stages, OrderedChunksCoverTheRangeAndStopWhenCanceled) {
  Progress progress;
  std::vector<std::size_t> seen;
  ordered_chunks(10, 4, &progress, [&](IndexRange range) {
    for (std::size_t i = range.begin; i < range.end; ++i)
      seen.push_back(i);
  });
  EXPECT_EQ(seen, (std::vector<std::size_t>{0, 1, 2, 3, 4, 5, 6, 7, 8, 9}));
  EXPECT_EQ(progress.fraction(), 0.8F);
  int chunks = 0;
  const auto cancel_at_second = [&](IndexRange) {
    if (++chunks == 2) progress.cancel();
  };
  EXPECT_THROW(ordered_chunks(100, 1, &progress, cancel_at_second), Cancelled);
  EXPECT_EQ(chunks, 2);
}

}  // namespace
}  // namespace mesher
