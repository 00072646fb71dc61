#include "engine/io/weld.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <random>
#include <vector>

#include "engine/core/error.h"

namespace mesher {
namespace {

TEST(Weld, NumbersPointsInOrderOfFirstAppearance) {
  const std::vector<std::uint32_t> items = {5, 1, 7, 2, 5, 1, 0, 0, 7, 2, 5, 2};
  const io::Weld welded = io::weld(items.data(), 2, 6);
  EXPECT_EQ(std::vector<std::uint32_t>(welded.index.begin(), welded.index.end()),
            (std::vector<std::uint32_t>{0, 1, 0, 2, 1, 3}));
  EXPECT_EQ(std::vector<std::uint32_t>(welded.first.begin(), welded.first.end()),
            (std::vector<std::uint32_t>{0, 1, 3, 5}));
}

TEST(Weld, EmptyInputGivesEmptyResult) {
  EXPECT_TRUE(io::weld(nullptr, 3, 0).first.empty());
}

TEST(Weld, AgreesWithAMap) {
  std::mt19937 random(1);
  for (const std::uint32_t range : {1U, 20U, 100000U}) {
    std::vector<std::uint32_t> items(30000);
    for (std::uint32_t& word : items)
      word = static_cast<std::uint32_t>(random() % range);
    const io::Weld welded = io::weld(items.data(), 3, 10000);
    std::map<std::vector<std::uint32_t>, std::uint32_t> numbers;
    for (std::uint32_t i = 0; i < 10000; ++i) {
      const std::vector<std::uint32_t> item(&items[3 * i], &items[3 * i] + 3);
      const auto [entry, is_new] =
          numbers.try_emplace(item, static_cast<std::uint32_t>(numbers.size()));
      ASSERT_EQ(welded.index[i], entry->second);
      if (is_new) {
        ASSERT_EQ(welded.first[entry->second], i);
      }
    }
  }
}

TEST(Weld, EqualItemsThatFillOneBucketAreJoined) {
  const std::vector<std::uint32_t> items(300'000, 7U);
  const io::Weld welded = io::weld(items.data(), 3, items.size() / 3);
  EXPECT_EQ(welded.first.size(), 1U);
  EXPECT_EQ(std::ranges::count(welded.index, 0U), 100'000);
}

TEST(Weld, StopsWhenCanceled) {
  const std::vector<std::uint32_t> items(300, 7U);
  Progress progress;
  progress.cancel();
  EXPECT_THROW((void)io::weld(items.data(), 3, 100, &progress), Cancelled);
}

}  // namespace
}  // namespace mesher
