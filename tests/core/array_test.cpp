#include "engine/core/array.h"

#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <fstream>
#include <memory>
#include <new>
#include <random>
#include <string>
#include <thread>
#include <utility>
#include <vector>

namespace mesher {
namespace {

// Growth within the capacity must not write the elements: the caller overwrites them anyway, and a
// second pass over the memory costs time.
TEST(Array, ResizeLeavesTrivialElementsUninitialized) {
  Array<std::uint32_t> a(64, 7U);
  a.resize(0);
  a.resize(64);
  // The allocator constructed nothing, so the old values are still there.
  for (const std::uint32_t value : a)
    EXPECT_EQ(value, 7U);
}

TEST(Array, DataIsAlignedToACacheLine) {
  for (std::size_t size = 1; size < std::size_t{64} << 20U; size = 3 * size + 1) {
    const Array<char> a(size);
    EXPECT_EQ(reinterpret_cast<std::uintptr_t>(a.data()) % 64, 0U) << size;
  }
}

TEST(Array, OversizedAllocationThrowsBadAlloc) {
  EXPECT_THROW(static_cast<void>(allocate_array(static_cast<std::size_t>(-1))), std::bad_alloc);
  EXPECT_THROW(static_cast<void>(allocate_array(static_cast<std::size_t>(-1) / 2 + 2)),
               std::bad_alloc);
}

TEST(Array, AssignAndResizeWithValueFillElements) {
  Array<float> a;
  a.assign(10, 2.5F);
  a.resize(20, 1.5F);
  EXPECT_EQ(a.front(), 2.5F);
  EXPECT_EQ(a.back(), 1.5F);
}

TEST(Array, NonTrivialElementsAreConstructed) {
  Array<std::string> names(3);
  names.resize(5);
  for (const std::string& name : names)
    EXPECT_TRUE(name.empty());
  Array<std::unique_ptr<int>> pointers(2);
  pointers.push_back(std::make_unique<int>(4));
  EXPECT_EQ(pointers[0], nullptr);
  EXPECT_EQ(*pointers[2], 4);
}

TEST(Array, CopyAndMoveBehaveLikeVector) {
  Array<int> a{1, 2, 3};
  const Array<int> copy = a;
  const int* data = a.data();
  const Array<int> moved = std::move(a);
  EXPECT_EQ(moved, copy);
  EXPECT_EQ(moved.data(), data);
}

// Arrays larger than a huge page are mapped from the system directly. The sizes are odd on purpose.
TEST(Array, LargeArraysKeepElementsWhenResized) {
  Array<std::uint32_t> a;
  for (const std::size_t n : {524'287U, 524'288U, 524'289U, 1'500'001U, 3'000'000U}) {
    const std::size_t before = a.size();
    a.resize(n);
    for (std::size_t i = before; i < n; ++i)
      a[i] = static_cast<std::uint32_t>(i);
    const Array<std::uint32_t> copy(a);
    for (std::size_t i = 0; i < n; i += 1021)
      ASSERT_EQ(copy[i], i);
    ASSERT_EQ(copy.back(), n - 1);
  }
#if !defined(MESHER_SANITIZED)  // AddressSanitizer aborts instead of throwing
  EXPECT_THROW(a.resize(a.max_size()), std::bad_alloc);
#endif
}

/// Creates and destroys random arrays, a few at a time, and checks that each keeps its contents.
void churn(std::uint32_t seed) {
  std::mt19937 random(seed);
  std::vector<Array<std::uint32_t>> arrays;
  for (int step = 0; step < 400; ++step) {
    if (arrays.size() < 12 || random() % 2 == 0) {
      // Sizes range from those that malloc serves to more than a huge page.
      const std::size_t bytes = 60'000 + random() % 2'200'000;
      arrays.emplace_back(bytes / 4, static_cast<std::uint32_t>(step) ^ seed);
    } else {
      const std::size_t i = random() % arrays.size();
      std::swap(arrays[i], arrays.back());
      const Array<std::uint32_t>& last = arrays.back();
      ASSERT_EQ(reinterpret_cast<std::uintptr_t>(last.data()) % alignof(std::uint32_t), 0U);
      for (std::size_t k = 0; k < last.size(); k += 509)
        ASSERT_EQ(last[k], last.front());
      ASSERT_EQ(last.back(), last.front());
      arrays.pop_back();
    }
  }
}

// Several arrays share a huge page. Each keeps its contents, on whichever thread it is created or
// destroyed.
TEST(Array, MediumArraysDoNotOverlapAcrossThreads) {
  std::vector<std::thread> threads;
  for (std::uint32_t seed = 1; seed <= 4; ++seed)
    threads.emplace_back(churn, seed);
  for (std::thread& thread : threads)
    thread.join();
}

TEST(Array, MediumArraysReturnMemoryWhenFreed) {
  const auto resident_pages = [] {
    std::size_t size = 0;
    std::size_t resident = 0;
    std::ifstream("/proc/self/statm") >> size >> resident;
    return resident;
  };
  const auto fill = [] {
    std::vector<Array<std::uint32_t>> arrays;
    for (int i = 0; i < 100; ++i)
      arrays.emplace_back(250'000, 1U);  // 1 MB each
  };
  fill();
  const std::size_t before = resident_pages();
  for (int i = 0; i < 5; ++i)
    fill();
#if !defined(MESHER_SANITIZED)                  // AddressSanitizer keeps freed memory for a while
  EXPECT_LT(resident_pages(), before + 5'000);  // 20 MB of 500 MB
#else
  EXPECT_GT(before, 0U);
#endif
}

}  // namespace
}  // namespace mesher
