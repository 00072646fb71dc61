#include "engine/core/job.h"

#include <gtest/gtest.h>

#include <new>
#include <string>

#include "engine/core/error.h"

namespace mesher {
namespace {

std::atomic<int> wakes{0};
void count_wake() {
  ++wakes;
}

/// Runs until it is canceled.
int endless(Progress& progress) {
  for (;;)
    report(&progress, 0.5F);
}

TEST(Job, ReturnsResultAndCallsWakeOnce) {
  wakes = 0;
  JobOf<std::string> job(
      "Thinking",
      [](Progress& progress) {
        progress.name_stage("hard");
        return std::string("done");
      },
      count_wake);
  job.wait();
  EXPECT_TRUE(job.is_done());
  EXPECT_EQ(wakes, 1);
  EXPECT_EQ(job.title(), "Thinking");
  EXPECT_EQ(job.progress().stage(), "hard");
  EXPECT_EQ(job.progress().fraction(), 1.0F) << "a finished job is finished entirely";
  EXPECT_GE(job.age_s(), 0.0);
  EXPECT_EQ(job.take(), "done");
}

TEST(Job, TakeRethrowsException) {
  JobOf<int> job(
      "Failing", [](Progress&) -> int { throw InputError("no"); }, nullptr);
  job.wait();
  EXPECT_THROW(job.take(), InputError);
}

TEST(Job, OutOfMemoryErrorNamesTheJob) {
  JobOf<int> job(
      "Opening a.obj", [](Progress&) -> int { throw std::bad_alloc(); }, nullptr);
  job.wait();
  try {
    job.take();
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.exit_code(), ExitCode::machine_lacks);
    EXPECT_STREQ(error.what(), "Opening a.obj: out of memory");
  }
}

TEST(Job, StopsWhenCanceledOrDestroyed) {
  JobOf<int> job("Running", endless, nullptr);
  job.cancel();
  job.wait();
  EXPECT_THROW(job.take(), Cancelled);
  const JobOf<int> destroyed("Running", endless, nullptr);
}

}  // namespace
}  // namespace mesher
