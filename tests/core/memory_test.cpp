#include "engine/core/memory.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include "tests/support/scarce_memory.h"

namespace mesher {
namespace {

TEST(AvailableMemory, IsSomeAndNotMoreThanTheMachineHas) {
  const auto physical = static_cast<std::uint64_t>(sysconf(_SC_PHYS_PAGES)) *
                        static_cast<std::uint64_t>(sysconf(_SC_PAGESIZE));
  EXPECT_GT(available_memory_bytes(), 0U);
  EXPECT_LE(available_memory_bytes(), physical);
}

TEST(AvailableMemory, IsCountedInBytes) {
  // A test that runs at all has a megabyte; in kilobytes that would read as a thousand.
  EXPECT_GT(available_memory_bytes(), 1'000'000U);
}

TEST(AvailableMemory, IsNotMoreThanTheProcessMayMap) {
  if (!test::kMemoryCanBeScarce) GTEST_SKIP();
  const test::ScarceMemory scarce(50'000'000);
  EXPECT_LE(available_memory_bytes(), 50'000'000U);
  EXPECT_GT(available_memory_bytes(), 1'000'000U);
}

TEST(ControlGroups, AreReadInBothVersions) {
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

TEST(ControlGroups, AreWithinTheirParents) {
  EXPECT_EQ(with_parents("/a/b.c/d"), (std::vector<std::string>{"/a/b.c/d", "/a/b.c", "/a", ""}));
  EXPECT_EQ(with_parents("/"), std::vector<std::string>{""});
  EXPECT_EQ(with_parents(""), std::vector<std::string>{""});
  EXPECT_EQ(with_parents("a"), (std::vector<std::string>{"a", ""}));
}

}  // namespace
}  // namespace mesher
