#include "app/files/load_job.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <string>
#include <thread>
#include <vector>

#include "engine/core/error.h"
#include "engine/io/write.h"
#include "tests/support/meshes.h"
#include "tests/support/sanitized.h"
#include "tests/support/temp_folder.h"
#include "tests/support/watched.h"

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

const std::vector<std::string> kLoadStages{"reading", "connecting", "building the mesh",
                                           "counting"};

TEST(LoadJob, HasOneProgressForEveryFormat) {
  const test::TempFolder folder;
  const Mesh mesh = test::built(test::torus(300, 300)).mesh;
  for (const char* name : {"t.obj", "t.ply", "t.stl", "t.off", "t.gltf", "t.glb"}) {
    SCOPED_TRACE(name);
    io::write_model(folder / name, mesh, {});
    const auto load = [&](Progress* progress) { (void)load_model(folder / name, {}, *progress); };
    test::expect_one_progress(test::watched(load), kLoadStages);
  }
  for (const char* name : {"t.ply", "t.stl"}) {
    SCOPED_TRACE(std::string(name) + " as text");
    io::write_model(folder / name, mesh, {}, {.ascii = true});
    const auto load = [&](Progress* progress) { (void)load_model(folder / name, {}, *progress); };
    test::expect_one_progress(test::watched(load), kLoadStages);
  }
}

TEST(LoadJob, ProgressMovesSteadily) {
  const test::TempFolder folder;
  const Mesh mesh = test::built(test::torus(1000, 700)).mesh;
  for (const char* name : {"t.obj", "t.ply", "t.stl", "t.off", "t.glb"}) {
    io::write_model(folder / name, mesh, {});
    const test::Watched seen =
        test::watched([&](Progress* progress) { (void)load_model(folder / name, {}, *progress); });
    EXPECT_LT(seen.largest_step(), 0.1F) << name;
  }
}

TEST(LoadJob, CanBeCanceledAtAnyMoment) {
  const test::TempFolder folder;
  // The sanitizers make reading twenty times as slow.
  const Mesh mesh = test::built(test::torus(test::kSanitized ? 250 : 1000, 700)).mesh;
  for (const char* name : {"t.obj", "t.ply", "t.stl", "t.off", "t.gltf", "t.glb"}) {
    io::write_model(folder / name, mesh, {});
    test::cancel_at_many_moments(name, [&](Progress* progress) {
      const LoadedModel loaded = open_model(folder / name, {.progress = progress});
      (void)statistics(loaded.model.mesh, progress);
    });
  }
}

}  // namespace
}  // namespace mesher::app
