#include "engine/core/canceled_jobs.h"

#include <gtest/gtest.h>

#include <atomic>
#include <memory>
#include <thread>

#include "engine/core/error.h"

namespace mesher {
namespace {

TEST(CanceledJobs, OwnerDoesNotWaitForTheEnd) {
  std::atomic<bool> may_end{false};
  auto job = std::make_unique<JobOf<int>>(
      "Dawdling",
      [&](Progress&) {
        while (!may_end)
          std::this_thread::yield();
        return 1;
      },
      nullptr);
  CanceledJobs canceled;
  EXPECT_TRUE(canceled.take(job));
  EXPECT_EQ(job, nullptr);
  canceled.reap();
  EXPECT_FALSE(canceled.is_empty());
  may_end = true;
  while (!canceled.is_empty())
    canceled.reap();
}

TEST(CanceledJobs, ResultIsFreedByTheJobsThread) {
  const auto held = std::make_shared<int>(1);
  std::atomic<bool> may_end{false};
  auto job = std::make_unique<JobOf<std::shared_ptr<int>>>(
      "Holding",
      [&may_end, held](Progress&) {
        while (!may_end)
          std::this_thread::yield();
        return held;
      },
      nullptr);
  job->cancel();
  may_end = true;
  job->wait();
  EXPECT_EQ(held.use_count(), 1) << "neither the work nor its result is left";
  EXPECT_THROW((void)job->take(), Cancelled);
}

TEST(CanceledJobs, SealedJobStaysWithItsOwner) {
  std::atomic<bool> is_sealed{false};
  std::atomic<bool> may_end{false};
  auto job = std::make_unique<JobOf<int>>(
      "Writing",
      [&](Progress& progress) {
        seal(&progress);
        is_sealed = true;
        while (!may_end)
          std::this_thread::yield();
        return 1;
      },
      nullptr);
  while (!is_sealed)
    std::this_thread::yield();
  CanceledJobs canceled;
  EXPECT_FALSE(canceled.take(job));
  ASSERT_NE(job, nullptr);
  may_end = true;
  job->wait();
  EXPECT_EQ(job->take(), 1);
}

}  // namespace
}  // namespace mesher
