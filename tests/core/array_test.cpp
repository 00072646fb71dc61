#include "engine/core/array.h"

#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <new>
#include <string>

namespace mesher {
namespace {

// Growing within the capacity must leave the bytes as they are: no second pass over memory that the
// caller overwrites anyway.
TEST(Array, ResizeDoesNotTouchTrivialElements) {
  Array<std::uint32_t> a(64, 7U);
  a.resize(0);
  a.resize(64);
  // The old values are still there (the allocator constructed nothing over them).
  for (const std::uint32_t value : a)
    EXPECT_EQ(value, 7U);
}

TEST(Array, FillingIsStillPossible) {
  Array<float> a;
  a.assign(10, 2.5F);
  a.resize(20, 1.5F);
  EXPECT_EQ(a.front(), 2.5F);
  EXPECT_EQ(a.back(), 1.5F);
}

TEST(Array, ElementsWithAConstructorAreConstructed) {
  Array<std::string> names(3);
  names.resize(5);
  for (const std::string& name : names)
    EXPECT_TRUE(name.empty());
  Array<std::unique_ptr<int>> pointers(2);
  pointers.push_back(std::make_unique<int>(4));
  EXPECT_EQ(pointers[0], nullptr);
  EXPECT_EQ(*pointers[2], 4);
}

TEST(Array, CopiesAndMovesLikeAVector) {
  Array<int> a{1, 2, 3};
  const Array<int> copy = a;
  const int* data = a.data();
  const Array<int> moved = std::move(a);
  EXPECT_EQ(moved, copy);
  EXPECT_EQ(moved.data(), data);
}

// Past a huge page memory comes from the system itself, in pieces of odd sizes.
TEST(Array, LargeOnesGrowAndShrink) {
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
#if !defined(__SANITIZE_ADDRESS__)  // which ends the program instead
  EXPECT_THROW(a.resize(a.max_size()), std::bad_alloc);
#endif
}

}  // namespace
}  // namespace mesher
