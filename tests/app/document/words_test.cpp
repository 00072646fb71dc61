#include "app/document/words.h"

#include <gtest/gtest.h>

namespace mesher::app {
namespace {

TEST(Words, DistancesAreInPercentOfDiagonal) {
  EXPECT_EQ(far_from("the input", 5.25), "far from the input: 5.25 % of the diagonal (RMS)");
  EXPECT_EQ(stop_text(simplify::StopReason::target_reached), "target reached");
  EXPECT_EQ(stop_text(simplify::StopReason::far_from_input),
            "fewer faces would be further than 5 % of the diagonal from the input");
}

}  // namespace
}  // namespace mesher::app
