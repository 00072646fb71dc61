#include "engine/core/memory.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <unistd.h>

#include <array>
#include <cstdlib>
#include <memory>
#include <new>
#include <string>
#include <vector>

#include "engine/core/array.h"
#include "engine/core/error.h"

namespace mesher {
namespace {

TEST(AvailableMemory, IsPositiveAndAtMostPhysicalMemory) {
  const auto physical = static_cast<std::uint64_t>(sysconf(_SC_PHYS_PAGES)) *
                        static_cast<std::uint64_t>(sysconf(_SC_PAGESIZE));
  EXPECT_GT(available_memory_bytes(), 0U);
  EXPECT_LE(available_memory_bytes(), physical);
}

TEST(AvailableMemory, IsInBytes) {
  // Any machine that runs this test has a megabyte free; in kilobytes that would be 1,000.
  EXPECT_GT(available_memory_bytes(), 1'000'000U);
}

TEST(AvailableMemory, RespectsAddressSpaceLimit) {
  rlimit before = {};
  ASSERT_EQ(getrlimit(RLIMIT_AS, &before), 0);
  // Read without a buffer on the heap, which would shrink the process when it is freed.
  std::array<char, 128> statm{};
  const int file = open("/proc/self/statm", O_RDONLY);
  ASSERT_GT(read(file, statm.data(), statm.size() - 1), 0);
  close(file);
  const std::uint64_t pages = std::strtoull(statm.data(), nullptr, 10);
  constexpr std::uint64_t kRoom = 500'000'000;
  const rlimit limit{pages * static_cast<std::uint64_t>(sysconf(_SC_PAGESIZE)) + kRoom,
                     before.rlim_max};
  ASSERT_EQ(setrlimit(RLIMIT_AS, &limit), 0);
  const std::uint64_t available = available_memory_bytes();
  setrlimit(RLIMIT_AS, &before);
  EXPECT_LE(available, kRoom);
  EXPECT_GT(available, 1'000'000U);
}

TEST(MemoryLimit, BoundsArraysAndAvailableMemory) {
  {
    const MemoryLimit limit(1'000'000);
    EXPECT_EQ(available_memory_bytes(), 1'000'000U);
    const Array<std::uint8_t> first(600'000);
    EXPECT_EQ(available_memory_bytes(), 400'000U);
    EXPECT_THROW(Array<std::uint8_t>(400'001), std::bad_alloc);
    EXPECT_NO_THROW(Array<std::uint8_t>(400'000));
  }
  EXPECT_NO_THROW(Array<std::uint8_t>(2'000'000));
}

TEST(MemoryLimit, IsOfWhatIsTakenAtOneTime) {
  const MemoryLimit limit(1'000'000);
  for (int i = 0; i < 10; ++i)
    EXPECT_NO_THROW(Array<std::uint8_t>(900'000));
  EXPECT_EQ(MemoryLimit::left(), 1'000'000U);
  EXPECT_EQ(MemoryLimit::peak(), 900'000U);
}

TEST(MemoryLimit, OfEverythingCountsContainersToo) {
  const MemoryLimit limit(1'000'000, MemoryLimit::Of::everything);
  const std::vector<char> first(600'000);
  EXPECT_LE(MemoryLimit::left(), 400'000U);
  EXPECT_THROW(std::vector<char>(500'000), std::bad_alloc);
  EXPECT_THROW(Array<char>(500'000), std::bad_alloc);
  EXPECT_EQ(MemoryLimit::refusal().find("--max-memory is 1 MB, of which 6"), 0U)
      << MemoryLimit::refusal();
}

TEST(MemoryLimit, SmallBlocksMayExceedItSomewhat) {
  const MemoryLimit limit(1000, MemoryLimit::Of::everything);
  std::vector<std::unique_ptr<char[]>> blocks;
  EXPECT_NO_THROW(blocks.push_back(std::make_unique<char[]>(10'000))) << "room for messages";
  blocks.reserve(4000);
  EXPECT_THROW(for (int i = 0; i < 4000; ++i) blocks.push_back(std::make_unique<char[]>(10'000)),
               std::bad_alloc)
      << "but not for 40 MB";
}

TEST(MemoryLimit, RefusalIsOfTheInputAndHasFigures) {
  {
    const MemoryLimit limit(1'000'000, MemoryLimit::Of::everything);
    EXPECT_FALSE(MemoryLimit::take(3'000'000));
    EXPECT_THROW(throw_out_of_memory("a.obj"), LimitError);
    try {
      throw_out_of_memory("a.obj");
    } catch (const LimitError& error) {
      EXPECT_EQ(error.exit_code(), ExitCode::bad_input);
      EXPECT_TRUE(std::string(error.what()).starts_with("a.obj: --max-memory is 1 MB, of which "));
      EXPECT_TRUE(std::string(error.what()).ends_with("are in use; 3 MB more are needed"));
    }
  }
  EXPECT_THROW(throw_out_of_memory("a.obj"), DeviceError);
}

TEST(ControlGroups, ParsesVersions1And2) {
  const GroupPaths v2 = parse_group_paths("0::/user.slice/a b.scope\n");
  EXPECT_EQ(v2.v2, "/user.slice/a b.scope");
  EXPECT_EQ(v2.v1, "");
  const GroupPaths v1 = parse_group_paths(
      "12:cpu,cpuacct:/cpus\n9:memory:/docker/12:34\n3:name=systemd:/init\n0::/both\n");
  EXPECT_EQ(v1.v1, "/docker/12:34");
  EXPECT_EQ(v1.v2, "/both");
  EXPECT_EQ(parse_group_paths("4:hugetlb,memory:/x").v1, "/x");
  EXPECT_EQ(parse_group_paths("4:memory2:/x").v1, "");
  EXPECT_EQ(parse_group_paths("nonsense\n1:more\n").v2, "");
}

TEST(ControlGroups, WithParentsListsAncestors) {
  EXPECT_EQ(with_parents("/a/b.c/d"), (std::vector<std::string>{"/a/b.c/d", "/a/b.c", "/a", ""}));
  EXPECT_EQ(with_parents("/"), std::vector<std::string>{""});
  EXPECT_EQ(with_parents(""), std::vector<std::string>{""});
  EXPECT_EQ(with_parents("a"), (std::vector<std::string>{"a", ""}));
}

}  // namespace
}  // namespace mesher
