#include "app/input/keys.h"

#include <gtest/gtest.h>

#include "engine/core/error.h"

namespace mesher::app {
namespace {

TEST(Keys, ParsesModifiersInAnyCase) {
  EXPECT_EQ(parse_key("w"), (KeyPress{"w", false, false}));
  EXPECT_EQ(parse_key("Shift+W"), (KeyPress{"w", true, false}));
  EXPECT_EQ(parse_key("CTRL+shift+z"), (KeyPress{"z", true, true}));
  EXPECT_EQ(parse_key("Esc"), (KeyPress{"escape", false, false}));
  EXPECT_EQ(parse_key("?"), (KeyPress{"/", true, false}));
}

TEST(Keys, InvalidKeysAreRejected) {
  EXPECT_FALSE(parse_key("").has_value());
  EXPECT_FALSE(parse_key("hyper+w").has_value());
  EXPECT_THROW(parse_keys("w meta+q"), UsageError);
}

TEST(Keys, ParsesLists) {
  EXPECT_EQ(
      parse_keys("  w  g F12 "),
      (std::vector<KeyPress>{{"w", false, false}, {"g", false, false}, {"f12", false, false}}));
  EXPECT_TRUE(parse_keys("").empty());
}

TEST(Keys, TextUsesCommonNotation) {
  EXPECT_EQ(to_text(KeyPress{"z", true, true}), "Ctrl+Shift+Z");
  EXPECT_EQ(to_text(KeyPress{"f12", false, false}), "F12");
  EXPECT_EQ(to_text(KeyPress{"escape", false, false}), "Esc");
}

}  // namespace
}  // namespace mesher::app
