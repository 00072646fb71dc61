#include "app/cli/arguments.h"

#include <gtest/gtest.h>

namespace mesher::app {
namespace {

using Words = std::vector<std::string>;

Words normalized(Words words) {
  return normalized_arguments(std::move(words), {"view", "render", "info"},
                              {"input", "size", "gouraud", "camera", "output"});
}

TEST(Arguments, SingleDashLongOptionsGetSecondDash) {
  EXPECT_EQ(normalized({"-input", "bunny.obj", "-size", "500", "-gouraud"}),
            (Words{"view", "--input", "bunny.obj", "--size", "500", "--gouraud"}));
}

TEST(Arguments, ShortOptionsAndNegativeValuesAreUnchanged) {
  EXPECT_EQ(normalized({"render", "a.obj", "-o", "b.png", "--camera", "-30,20"}),
            (Words{"render", "a.obj", "-o", "b.png", "--camera", "-30,20"}));
}

TEST(Arguments, OnlyKnownOptionNamesGetSecondDash) {
  EXPECT_EQ(normalized({"info", "-x.obj", "-oy.obj", "-size=5"}),
            (Words{"info", "-x.obj", "-oy.obj", "--size=5"}));
}

TEST(Arguments, ViewIsDefaultCommand) {
  EXPECT_EQ(normalized({"bunny.obj"}), (Words{"view", "bunny.obj"}));
  EXPECT_EQ(normalized({}), (Words{"view"}));
  EXPECT_EQ(normalized({"info", "bunny.obj"}), (Words{"info", "bunny.obj"}));
  EXPECT_EQ(normalized({"--help"}), (Words{"--help"}));
}

TEST(Arguments, ArgumentsAfterDoubleDashAreUnchanged) {
  EXPECT_EQ(normalized({"info", "--", "-odd-name.obj"}), (Words{"info", "--", "-odd-name.obj"}));
}

}  // namespace
}  // namespace mesher::app
