#include "app/files/load_job.h"

#include <gtest/gtest.h>

#include <chrono>

#include "engine/core/error.h"
#include "tests/support/temp_folder.h"

namespace mesher::app {
namespace {

std::atomic<int> wakes{0};
void count_wake() {
  ++wakes;
}

void wait_for(const LoadJob& job) {
  for (int i = 0; i < 3000 && !job.is_done(); ++i) {
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  ASSERT_TRUE(job.is_done());
}

TEST(LoadJob, ReturnsModelWithStatisticsAndWakesOnce) {
  wakes = 0;
  {
    LoadJob job(MESHER_SOURCE_DIR "/assets/cube.obj", {}, count_wake);
    wait_for(job);
    const LoadedModel loaded = job.take();
    EXPECT_EQ(loaded.statistics.faces, 12U);
    EXPECT_EQ(loaded.model.name, "cube.obj");
  }
  EXPECT_EQ(wakes, 1);
}

TEST(LoadJob, ThrowsExceptionOfReader) {
  const test::TempFolder folder;
  LoadJob job(folder.write("bad.obj", "v 0 0 0\nv 1 0 zero\n"), {}, count_wake);
  wait_for(job);
  try {
    (void)job.take();
    FAIL() << "a bad file was accepted";
  } catch (const InputError& error) {
    EXPECT_EQ(error.line(), 2U);
  }
}

TEST(LoadJob, StopsWhenCanceled) {
  const test::TempFolder folder;
  std::string big;
  for (int i = 0; i < 400'000; ++i)
    big += "v 1.5 2.5 3.5\nf -1 -1 -1\n";
  const auto file = folder.write("big.obj", big);
  wakes = 0;
  LoadJob job(file, {}, count_wake);
  job.cancel();
  wait_for(job);
  EXPECT_THROW((void)job.take(), Cancelled);
  EXPECT_EQ(wakes, 1);
}

}  // namespace
}  // namespace mesher::app
