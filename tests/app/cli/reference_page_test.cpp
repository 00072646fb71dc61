#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <sstream>
#include <string>
#include <string_view>

#include "app/document/picture_options.h"
#include "app/document/progressive_view.h"
#include "app/document/simplification.h"
#include "app/edit/edit_text.h"
#include "app/input/commands.h"
#include "engine/core/option.h"
#include "engine/io/format.h"
#include "engine/render/settings.h"
#include "engine/subdivide/options.h"

namespace mesher::app {
namespace {

/// The values that an option takes: "quadric, accumulated", "0 to 180 deg", "".
template <class S>
std::string values_of(const Option<S>& option) {
  if (const auto* member = std::get_if<EnumMember<S>>(&option.member)) {
    std::string words;
    for (std::size_t i = 0; i < member->count; ++i)
      words += (i > 0 ? ", `" : "`") + std::string(member->text(i).key) + "`";
    return words;
  }
  if (std::holds_alternative<bool S::*>(option.member)) return "";
  char range[64];
  if (std::isinf(option.most)) {
    std::snprintf(range, sizeof range, "%g or more", option.least);
  } else {
    std::snprintf(range, sizeof range, "%g to %g", option.least, option.most);
  }
  return range + (*option.unit != '\0' ? std::string(" ") + option.unit : "");
}

template <class S, std::size_t N>
void write_table(std::ostream& page, const char* title, const char* intro,
                 const std::array<Option<S>, N>& table) {
  page << "\n## " << title << "\n\n"
       << intro << "\n\n| option | JSON key | values | default | effect |\n|---|---|---|---|---|\n";
  for (const Option<S>& option : table) {
    page << "| `--" << option.key << "` | `" << json_key(option) << "` | " << values_of(option)
         << " | " << default_text(option) << " | " << option.help << " |\n";
  }
  for (const Option<S>& option : table) {
    const auto* member = std::get_if<EnumMember<S>>(&option.member);
    if (member == nullptr) continue;
    page << "\n`--" << option.key << "`:\n\n";
    for (std::size_t i = 0; i < member->count; ++i) {
      const ChoiceText& text = member->text(i);
      page << "- `" << text.key << "`" << (*text.help != '\0' ? ": " : "") << text.help << "\n";
    }
  }
}

std::string keys_in_code(const Command& command) {
  std::string text;
  for (const KeyPress& key : parse_keys(command.keys))
    text += (text.empty() ? "`" : ", `") + to_text(key) + "`";
  return text;
}

const char* text_of(io::HoldsMaterials holds) {
  if (io::holds_look(holds)) return "yes";
  return holds == io::HoldsMaterials::nothing ? "no" : "color textures";
}

const char* text_of(io::Holds holds) {
  switch (holds) {
    case io::Holds::nothing:
      return "no";
    case io::Holds::one_per_vertex:
      return "one per vertex";
    case io::Holds::all_or_none:
      return "if no corner lacks it";
    case io::Holds::each_corner:
      return "yes";
  }
  return "";
}

std::string reference_page() {
  std::ostringstream page;
  page
      << "# Reference\n\nThis page is generated from the tables in the sources. A test compares it "
         "with them.\n";
  write_table(
      page, "Simplification",
      "`simplify`, `progressive` and `lods` take these options; so does the Simplify panel.",
      simplify::kSimplifyRules);
  write_table(page, "Subdivision", "`subdivide` and the Subdivide panel take these options.",
              subdivide::kSubdivideRules);
  write_table(page, "Rendering",
              "`view` and `render` take these options; the info panel sets most of them.",
              render::kRenderOptions);
  write_table(page, "Pictures", "`render` takes these options.", kPictureOptions);
  write_table(page, "Turntables", "`render --turntable` takes these options.", kTurntableOptions);
  write_table(page, "Progressive mode",
              "The Progressive mesh panel sets these options; `progressive` takes `--base-faces`.",
              kProgressiveOptions);
  page << "\n## Formats\n\n| format | extension | creases | groups | materials | texture "
          "coordinates | normals "
          "| "
          "colors |\n|---|---|---|---|---|---|---|---|\n";
  for (const io::FormatInfo& format : io::formats()) {
    if (format.write == nullptr) continue;
    page << "| " << format.name << " | `" << format.extension << "` | "
         << (format.holds.creases ? "yes" : "no") << " | " << (format.holds.groups ? "yes" : "no")
         << " | " << text_of(format.holds.materials) << " | " << text_of(format.holds.texcoord)
         << " | " << text_of(format.holds.normal) << " | " << text_of(format.holds.color) << " |\n";
  }
  page << "\n## Keys\n\nThe sources refer to a command by its id.\n";
  for (const Choice<CommandGroup>& group : kCommandGroups) {
    page << "\n### " << group.text.label << "\n\n| key | command | id |\n|---|---|---|\n";
    for (const Command& command : commands()) {
      if (command.group != group.value) continue;
      page << "| " << keys_in_code(command) << " | " << command.help << " | `" << command.id
           << "` |\n";
    }
  }
  page << "\n## Edits\n\n`mesher edit --do` takes the ids of commands that change the model, and "
          "these edits with values (`simplify_to faces=500 cost=length`). Rules of simplification "
          "also include `max-error=PERCENT`. `mesh` is the number of a mesh of the scene, in the "
          "order of the file. An edge is named by its lower half-edge; without "
          "`edges`, the selected edges are meant.\n\n| edit | values | effect |\n|---|---|---|\n";
  for (const EditKind& kind : edit_kinds())
    page << "| `" << kind.name << "` | " << kind.values << " | " << kind.help << " |\n";
  return page.str();
}

// MESHER_UPDATE_REFERENCE=1 writes the page instead.
/// The words of an option on the command line, in a panel and in the documentation agree.
template <class S, std::size_t N>
void expect_labels(const std::array<Option<S>, N>& table) {
  for (const Option<S>& option : table) {
    std::string words = option.key;
    std::replace(words.begin(), words.end(), '-', ' ');
    EXPECT_EQ(std::string_view(option.label).substr(0, words.size()), words);
  }
}

TEST(OptionTables, LabelsAreTheKeys) {
  expect_labels(simplify::kSimplifyRules);
  expect_labels(kSimplifyLimits);
  expect_labels(subdivide::kSubdivideRules);
  expect_labels(render::kRenderOptions);
  expect_labels(kPictureOptions);
  expect_labels(kTurntableOptions);
  expect_labels(kProgressiveOptions);
}

TEST(ReferencePage, MatchesTheTablesInTheSources) {
  const std::string file = MESHER_SOURCE_DIR "/docs/reference.md";
  const std::string expected = reference_page();
  if (std::getenv("MESHER_UPDATE_REFERENCE") != nullptr) std::ofstream(file) << expected;
  std::ostringstream actual;
  actual << std::ifstream(file).rdbuf();
  EXPECT_EQ(actual.str(), expected) << "run the test with MESHER_UPDATE_REFERENCE=1 to update it";
}

}  // namespace
}  // namespace mesher::app
