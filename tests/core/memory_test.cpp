#include "engine/core/memory.h"

#include <gtest/gtest.h>
#include <unistd.h>

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

}  // namespace
}  // namespace mesher
