#include "app/edit/memory_budget.h"

#include <gtest/gtest.h>

#include <limits>

namespace mesher::app {
namespace {

TEST(BytesText, ChoosesReadableUnit) {
  EXPECT_EQ(bytes_text(0), "0 B");
  EXPECT_EQ(bytes_text(999), "999 B");
  EXPECT_EQ(bytes_text(1000), "1 kB");
  EXPECT_EQ(bytes_text(1'540), "1.5 kB");
  EXPECT_EQ(bytes_text(12'400'000), "12 MB");
  EXPECT_EQ(bytes_text(1'500'000'000), "1.5 GB");
  EXPECT_EQ(bytes_text(3'210'000'000'000), "3.2 TB");
  EXPECT_EQ(bytes_text(50'000'000'000'000'000), "50000 TB");
}

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
            "subdividing 2 times would make 4,000,000 faces and need 160 kB of memory; 40 kB is "
            "free");
  EXPECT_NE(subdivision_refusal(kSize, 1, {.available = 40'000, .copies = 1})
                .find("subdividing 1 time would"),
            std::string::npos);
  EXPECT_NE(subdivision_refusal(kSize, 2, {.available = 40'000, .copies = 2}).find("need 260 kB"),
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

TEST(MemoryBudget, TextHasAtMostThreeDigits) {
  EXPECT_EQ(bytes_text(999), "999 B");
  EXPECT_EQ(bytes_text(999'400), "999 kB");
  EXPECT_EQ(bytes_text(999'999), "1 MB");
  EXPECT_EQ(bytes_text(999'999'999), "1 GB");
}

}  // namespace
}  // namespace mesher::app
