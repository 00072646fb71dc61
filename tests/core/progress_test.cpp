#include "engine/core/progress.h"

#include <gtest/gtest.h>

#include <thread>

#include "engine/core/error.h"

namespace mesher {
namespace {

TEST(Progress, StoresStageAndFraction) {
  Progress progress;
  begin_stage(&progress, "reading bunny.obj");
  report(&progress, 0.5F);
  EXPECT_EQ(progress.stage(), "reading bunny.obj");
  EXPECT_EQ(progress.fraction(), 0.5F);
}

TEST(Progress, NewStageStartsAtZero) {
  Progress progress;
  begin_stage(&progress, "reading");
  report(&progress, 0.9F);
  begin_stage(&progress, "building");
  EXPECT_EQ(progress.stage(), "building");
  EXPECT_EQ(progress.fraction(), 0.0F);
}

TEST(Progress, NullProgressIsIgnored) {
  EXPECT_NO_THROW(begin_stage(nullptr, "reading"));
  EXPECT_NO_THROW(report(nullptr, 0.5F));
}

TEST(Progress, CancelThrowsAtNextReport) {
  Progress progress;
  begin_stage(&progress, "reading");
  EXPECT_FALSE(progress.is_cancelled());
  progress.cancel();
  EXPECT_TRUE(progress.is_cancelled());
  EXPECT_THROW(report(&progress, 0.5F), Cancelled);
  EXPECT_THROW(begin_stage(&progress, "building"), Cancelled);
  EXPECT_EQ(progress.stage(), "reading");
  EXPECT_EQ(progress.fraction(), 0.0F);
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

}  // namespace
}  // namespace mesher
