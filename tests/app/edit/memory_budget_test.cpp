#include "app/edit/memory_budget.h"

#include <gtest/gtest.h>

#include <limits>

namespace mesher::app {
namespace {

constexpr subdivide::SubdivisionSize kSize{
    .faces = 4'000'000, .result_bytes = 100'000, .peak_bytes = 160'000};

TEST(SubdivisionRefusal, IsEmptyIfAFifthOfMemoryStaysFree) {
  EXPECT_EQ(subdivision_refusal(kSize, 2, {.available = 200'000, .copies = 1}), "");
  EXPECT_NE(subdivision_refusal(kSize, 2, {.available = 199'990, .copies = 1}), "");
  EXPECT_EQ(subdivision_refusal(
                kSize, 2, {.available = std::numeric_limits<std::uint64_t>::max(), .copies = 1}),
            "");
}

TEST(SubdivisionRefusal, CountsEveryCopy) {
  EXPECT_EQ(subdivision_refusal(kSize, 2, {.available = 325'000, .copies = 2}), "");
  EXPECT_NE(subdivision_refusal(kSize, 2, {.available = 324'990, .copies = 2}), "");
}

TEST(SubdivisionRefusal, NamesNeededAndFreeMemory) {
  EXPECT_EQ(subdivision_refusal(kSize, 2, {.available = 40'000, .copies = 1}),
            "subdividing 2 times would make 4,000,000 faces, which needs 160 kB of memory; the "
            "limit is four fifths of the 40 kB that are free");
  EXPECT_NE(subdivision_refusal(kSize, 1, {.available = 40'000, .copies = 1})
                .find("subdividing 1 time would"),
            std::string::npos);
  EXPECT_NE(subdivision_refusal(kSize, 2, {.available = 40'000, .copies = 2}).find("needs 260 kB"),
            std::string::npos);
}

TEST(SubdivisionRefusal, IndexOverflowDoesNotDependOnMemory) {
  subdivide::SubdivisionSize size = kSize;
  size.has_ids = false;
  EXPECT_EQ(subdivision_refusal(
                size, 9, {.available = std::numeric_limits<std::uint64_t>::max(), .copies = 1}),
            "subdividing 9 times would make 4,000,000 faces or more: too many for 32-bit indices");
}

TEST(MemoryBudget, CountsMemoryBesidesMesh) {
  EXPECT_EQ(subdivision_refusal(kSize, 2, {.available = 200'000}), "");
  EXPECT_NE(subdivision_refusal(kSize, 2, {.available = 200'000, .beside = 100}), "");
}

TEST(MemoryBudget, CountsMemoryOfShownModel) {
  EXPECT_EQ(subdivision_refusal(kSize, 2, {.available = 325'000, .copies = 1, .held = 100'000}),
            "");
  EXPECT_NE(subdivision_refusal(kSize, 2, {.available = 324'990, .copies = 1, .held = 100'000}),
            "");
}

}  // namespace
}  // namespace mesher::app
