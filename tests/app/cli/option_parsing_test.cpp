#include "app/cli/option_parsing.h"

#include <gtest/gtest.h>

#include "app/document/json.h"
#include "app/document/progressive_view.h"
#include "engine/render/settings.h"
#include "engine/simplify/options.h"
#include "engine/subdivide/options.h"

namespace mesher::app {
namespace {

/// Parses words as the options of one table.
template <class S, std::size_t N>
S parsed(const std::array<Option<S>, N>& table, std::vector<std::string> words) {
  CLI::App command;
  S options{};
  add_options(command, table, options);
  std::reverse(words.begin(), words.end());  // as CLI11 expects them
  command.parse(std::move(words));
  return options;
}

/// Expects that every choice of every enumeration in the table is parsed into its value and printed
/// as its key, and that other words are rejected.
template <class S, std::size_t N>
void expect_choices_parsed(const std::array<Option<S>, N>& table) {
  for (const Option<S>& option : table) {
    const auto* member = std::get_if<EnumMember<S>>(&option.member);
    if (member == nullptr) continue;
    const std::string name = std::string("--") + option.key;
    for (std::size_t i = 0; i < member->count; ++i) {
      const ChoiceText& text = member->text(i);
      const S options = parsed(table, {name, text.key});
      EXPECT_EQ(member->get(options), i) << name << " " << text.key;
      EXPECT_EQ(options_json(table, options)[json_key(option)], text.key);
      if (text.alias == nullptr) continue;
      EXPECT_EQ(member->get(parsed(table, {name, text.alias})), i);
    }
    EXPECT_THROW((void)parsed(table, {name, "no-such-word"}), CLI::ParseError);
    EXPECT_THROW((void)parsed(table, {name, ""}), CLI::ParseError);
  }
}

TEST(OptionParsing, EveryChoiceIsParsedAndPrinted) {
  expect_choices_parsed(simplify::kSimplifyRules);
  expect_choices_parsed(subdivide::kSubdivideRules);
  expect_choices_parsed(render::kRenderOptions);
  EXPECT_EQ(parsed(simplify::kSimplifyRules, {"--cost", "qem"}).cost,
            simplify::CostPolicy::quadric);
}

TEST(OptionParsing, NoArgumentsGiveDefaults) {
  EXPECT_EQ(parsed(simplify::kSimplifyRules, {}), simplify::SimplifyOptions{});
  EXPECT_EQ(parsed(subdivide::kSubdivideRules, {}), subdivide::SubdivideOptions{});
  EXPECT_EQ(parsed(render::kRenderOptions, {}), render::Settings{});
}

TEST(OptionParsing, NumbersAndFlagsReachTheirMembers) {
  const simplify::SimplifyOptions o =
      parsed(simplify::kSimplifyRules,
             {"--crease-angle", "30", "--seed", "18446744073709551615", "--no-intersections"});
  EXPECT_EQ(o.crease_angle_deg, 30.0F);
  EXPECT_EQ(o.seed, ~std::uint64_t{0});
  EXPECT_TRUE(o.no_intersections);
  EXPECT_TRUE(parsed(subdivide::kSubdivideRules, {"--limit"}).limit);
}

TEST(OptionParsing, NumbersOutOfRangeAreRejected) {
  for (const char* angle : {"-1", "180.5", "nan", "inf", "x", "", "30x"})
    EXPECT_THROW((void)parsed(simplify::kSimplifyRules, {"--crease-angle", angle}), CLI::ParseError)
        << angle;
  for (const char* seed : {"-1", "1.5", "x", "18446744073709551616"})
    EXPECT_THROW((void)parsed(simplify::kSimplifyRules, {"--seed", seed}), CLI::ParseError) << seed;
}

TEST(OptionParsing, HelpNamesUnitAndDefault) {
  EXPECT_EQ(help_text(option_named(simplify::kSimplifyRules, "cost")),
            "which edge to collapse first (default: quadric)");
  EXPECT_EQ(help_text(option_named(simplify::kSimplifyRules, "crease-angle")),
            "also treat edges whose face normals differ by more than this as creases [deg] "
            "(default: 180: tagged only)");
}

TEST(OptionParsing, JsonKeysContainUnit) {
  const Json json = options_json(simplify::kSimplifyRules, simplify::SimplifyOptions{});
  EXPECT_EQ(json["crease_angle_deg"], 180.0F);
  EXPECT_EQ(json["no_intersections"], false);
  EXPECT_EQ(options_json(kProgressiveOptions, ProgressiveSettings{})["tolerance_px"], 1.0F);
}

}  // namespace
}  // namespace mesher::app
