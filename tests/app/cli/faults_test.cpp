// Tests commands with a full disk, a lost GPU and an environment in which much is missing.
#include <vulkan/vulkan_core.h>

#include <algorithm>

#include "tests/app/program_test.h"
#include "tests/support/fault_layer.h"
#include "tests/support/small_disk.h"

namespace mesher::test {
namespace {

class FaultyMachine : public ProgramTest {
 protected:
  /// Expects exit code `code` and one line on stderr, which ends with `words`.
  static void expect_refusal(const Finished& run, int code, const std::string& words) {
    EXPECT_EQ(run.exit_code, code);
    EXPECT_EQ(std::ranges::count(run.err, '\n'), 1) << run.err;
    EXPECT_TRUE(run.err.ends_with(words + "\n")) << run.err;
    EXPECT_EQ(run.out, "");
  }
};

TEST_F(FaultyMachine, EveryCommandSaysThatTheDiskIsFull) {
  const SmallDisk disk;
  disk.fill();
  const auto file = [&](const char* name) { return (disk / name).string(); };
  for (const std::vector<std::string>& arguments :
       {std::vector<std::string>{"convert", "knot", file("m.ply")},
        {"simplify", "knot", "-o", file("m.obj"), "--faces", "500"},
        {"subdivide", "cube", "-o", file("m.glb")},
        {"progressive", "knot", "-o", file("m.pm")},
        {"lods", "knot", "-o", file("l.glb")},
        {"edit", "knot", "-o", file("m.off"), "--do", "subdivide"},
        {"render", "knot", "-o", file("p.png"), "--size", "200"},
        {"render", "knot", "-o", file("p.webp"), "--size", "200"},
        {"render", "knot", "-o", file("t.webp"), "--size", "60", "--turntable", "--frames", "3"},
        {"render", "knot", "-o", file("t#.png"), "--size", "60", "--turntable", "--frames", "3"},
        {"view", "knot", "--screenshot", file("p.png"), "--size", "200"}}) {
    SCOPED_TRACE(testing::PrintToString(arguments));
    std::vector<std::string> quiet = arguments;
    quiet.emplace_back("--quiet");
    expect_refusal(mesher(quiet), 4, "cannot write: No space left on device");
    EXPECT_EQ(disk.count_files(), 0U);
  }
}

TEST_F(FaultyMachine, LostGpuIsOneLine) {
  const FaultLayer faults;
  for (const char* call : {"vkQueueSubmit2", "vkWaitSemaphores"}) {
    faults.cue({{call, VK_ERROR_DEVICE_LOST}});
    expect_refusal(
        mesher({"render", "knot", "-o", "p.png", "--validation", "--quiet"}, faults.environment()),
        3, std::string("the GPU stopped working (") + call + ": VK_ERROR_DEVICE_LOST)");
    EXPECT_TRUE(faults.is_over());
    EXPECT_EQ(folder_.count_files(), 0U);
  }
  const Finished after = mesher({"render", "knot", "-o", "p.png"}, faults.environment());
  EXPECT_EQ(after.exit_code, 0) << after.err;
}

TEST_F(FaultyMachine, FullGpuIsOneLine) {
  const FaultLayer faults;
  faults.cue({{"vkAllocateMemory", VK_ERROR_OUT_OF_DEVICE_MEMORY, 1, 30'000}});
  expect_refusal(
      mesher({"render", "knot", "-o", "p.png", "--validation", "--quiet"}, faults.environment()), 3,
      "out of GPU memory (vkAllocateMemory: VK_ERROR_OUT_OF_DEVICE_MEMORY)");
  EXPECT_TRUE(faults.is_over());
  EXPECT_EQ(folder_.count_files(), 0U);
}

}  // namespace
}  // namespace mesher::test
