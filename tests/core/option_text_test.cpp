#include "engine/core/option_text.h"

#include <gtest/gtest.h>

namespace mesher {
namespace {

enum class Color { red, green };
constexpr Choices<Color, 2> kColors{
    {{Color::red, {"red", "red"}}, {Color::green, {"green", "green"}}}};
constexpr const auto& choices(Color) {
  return kColors;
}

struct Settings {
  Color color = Color::red;
  bool is_on = false;
  float angle = 180.0F;
  std::uint64_t seed = 1;
  std::uint32_t faces = 0;
};
constexpr std::array kSettings{
    Option<Settings>{
        .key = "color", .label = "", .help = "", .member = enum_member<&Settings::color>()},
    Option<Settings>{.key = "is-on", .label = "", .help = "", .member = &Settings::is_on},
    Option<Settings>{
        .key = "angle", .label = "", .help = "", .member = &Settings::angle, .most = 180.0},
    Option<Settings>{.key = "seed", .label = "", .help = "", .member = &Settings::seed},
    Option<Settings>{
        .key = "faces", .label = "", .help = "", .member = &Settings::faces, .least = 1.0},
};

TEST(OptionText, ListsEveryOption) {
  std::string words;
  append_options(words, kSettings, Settings{});
  EXPECT_EQ(words, " color=red is-on=off angle=180 seed=1 faces=0");
}

TEST(OptionText, RestoresExactValues) {
  const Settings wanted{Color::green, true, 0.1F, 18'446'744'073'709'551'615ULL, 4'294'967'295U};
  Settings read;
  for (const Option<Settings>& option : kSettings)
    EXPECT_TRUE(set_option(option, read, value_text(option, wanted))) << option.key;
  EXPECT_EQ(read.color, wanted.color);
  EXPECT_EQ(read.is_on, wanted.is_on);
  EXPECT_EQ(read.angle, wanted.angle);
  EXPECT_EQ(read.seed, wanted.seed);
  EXPECT_EQ(read.faces, wanted.faces);
}

TEST(OptionText, RefusesWhatIsNoValue) {
  Settings settings;
  const std::pair<const char*, const char*> bad[] = {
      {"color", "blue"}, {"color", ""},   {"is-on", "yes"}, {"angle", "181"},
      {"angle", "nan"},  {"angle", "-1"}, {"angle", "1 "},  {"angle", ""},
      {"seed", "-1"},    {"seed", "1.5"}, {"faces", "0"},   {"faces", "4294967296"}};
  for (const auto& [key, text] : bad)
    EXPECT_FALSE(set_option(option_named(kSettings, key), settings, text)) << key << "=" << text;
  EXPECT_EQ(settings.angle, 180.0F) << "a refusal changes nothing";
  EXPECT_EQ(settings.seed, 1U);
}

}  // namespace
}  // namespace mesher
