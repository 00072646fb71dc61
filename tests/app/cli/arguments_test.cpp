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

TEST(NearestName, IsWithinTwoLettersAndHalfOfTheName) {
  const Words names{"gouraud", "size", "input", "wireframe", "lod", "limit"};
  EXPECT_EQ(nearest_name("gourad", names), "gouraud");
  EXPECT_EQ(nearest_name("guoraud", names), "gouraud") << "swapped letters are one mistake";
  EXPECT_EQ(nearest_name("wirefame", names), "wireframe");
  EXPECT_EQ(nearest_name("inptu", names), "input");
  EXPECT_EQ(nearest_name("sizes", names), "size");
  EXPECT_EQ(nearest_name("gouraud", names), "gouraud");
  EXPECT_EQ(nearest_name("gurd", names), "");
  EXPECT_EQ(nearest_name("xy", names), "");
  EXPECT_EQ(nearest_name("lad", names), "lod");
  EXPECT_EQ(nearest_name("ab", names), "");
  EXPECT_EQ(nearest_name("", names), "");
  EXPECT_EQ(nearest_name(std::string(1'000'000, 'x'), names), "");
}

TEST(Suggestions, ListUnknownOptionsOnly) {
  const Words options{"gouraud", "size", "output"};
  EXPECT_EQ(suggestions({"cube", "-gourad", "--size", "5", "--ouput=x.png", "-o", "y"}, options),
            (Words{"-gourad: did you mean -gouraud?", "--ouput=x.png: did you mean --output?"}));
  EXPECT_TRUE(suggestions({"cube", "--", "-gourad"}, options).empty());
  EXPECT_TRUE(suggestions({"-", "--", "-"}, options).empty());
}

}  // namespace
}  // namespace mesher::app
