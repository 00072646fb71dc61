#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <string>
#include <string_view>
#include <type_traits>
#include <variant>

#include "app/ui/panels.h"
#include "engine/core/option.h"

namespace mesher::app {

// The frame that all panels share.

/// Notes widgets and texts here from now on.
void note_in(Noted& noted);
/// Notes the area of the last widget, as "window/name", without what follows ##, and
/// for a name with ###, only what follows it. Of equal names, the later ones get a number: "tab
/// cube.obj (2)". Notes the name as a text as well, but not the area of what is scrolled out of
/// sight.
void note_widget(std::string_view name);
/// Notes a text that is drawn, so that the font gets its glyphs. The functions below note theirs:
/// call this for names that ImGui is given directly.
void note_text(std::string_view text);
void note_code_points(const CodePoints& code_points);
/// Adds the current ImGui window. Call between its Begin and End.
void note_area(PanelAreas& areas);

/// Begins a part of the window that cannot be moved. Call `end_part` if it returns true; it returns
/// false for an empty rectangle.
bool begin_part(const char* name, const Rect& place, bool has_margin = true);
void end_part(PanelAreas& areas);
/// Begins a dialog in the middle of the window, not larger than that. Call `end_dialog` either way.
bool begin_dialog(const char* title, bool* is_open, float width_points);
void end_dialog(PanelAreas& areas);

/// The part that shows the tool's panel.
inline constexpr const char* kToolPanel = "panel";

/// The name of a block of a panel.
void heading(const char* name);
/// Writes a label into the first column; the next widget fills the second.
void label(const char* text);
/// Draws a check mark into the last widget, behind its text.
void check_mark(const char* text);
/// Draws a text over the last widget, a Selectable without a label. What is beyond `end` is
/// replaced by dots. Returns whether all of it fits: else give it a tooltip.
bool ellipsis_text(const std::string& text, float end, bool is_possible = true);
/// The right end of the window or of the column of a table, as ellipsis_text takes it.
float content_end();
/// Adds a tooltip to the last widget, even if that is disabled.
void tooltip(const char* text);
/// Begins a table of two columns; `row` fills it. Call ImGui::EndTable if it returns true.
bool begin_rows(const char* name);
/// A row of a two-column table.
void row(const char* name, const std::string& value);
/// A button of half the panel's width.
bool half_button(const char* name, bool is_possible, const char* help);
/// A button of the panel's width.
bool wide_button(const char* name, bool is_possible, const char* help);
/// Text in `color` that is wrapped at the end of the window.
void wrapped_text(const std::string& text, const glm::vec3& color);
void faint_text(const std::string& text);
void remark_text(const std::string& text);
void problem_text(const std::string& text);
/// Draws a labeled field for a number of things, with commas. `none`: the words that an empty field
/// shows, which stands for 0; null: the field cannot be empty. Returns whether it changed.
bool edit_count(const char* what, std::uint32_t& value, const char* help,
                const char* none = nullptr);

// The widgets of options.

/// How a number is shown and limited.
struct NumberRange {
  double least;
  double most;
  const char* unit;
  double special;             ///< a value that is shown as words
  const char* special_label;  ///< those words
  std::string help;           ///< tooltip
};

void begin_disabled(bool is_disabled);
void end_disabled();
/// Draws a labeled checkbox. Returns whether it was clicked.
bool edit_switch(const char* what, bool& value, const std::string& help);

/// Draws a labeled list of choices. `text` returns the words for a choice. `option`: its name on
/// the command line, for the tooltips; empty: it has none. Returns the chosen index.
std::size_t choose(const char* what, std::size_t count, const ChoiceText& (*text)(std::size_t),
                   std::size_t current, const char* help, const std::string& option);

struct SliderRange {
  float least;
  float most;
  bool is_logarithmic = false;
  bool* is_activated = nullptr;  ///< receives whether a drag began
};
/// Draws a labeled slider with a text beside it. Returns whether the value changed.
bool edit_slider(const char* what, float& value, const SliderRange& range, const std::string& text,
                 const char* help);

/// Draws a labeled field for a number. A range that is at most some tens of times its lower end
/// gets a slider, a wider one a logarithmic slider, an open one a field to type in. The number
/// stands beside the slider, so that the knob does not cover it. An empty field stands for the
/// special value.
bool edit_number(const char* what, float& value, const NumberRange& range);
bool edit_number(const char* what, std::uint32_t& value, const NumberRange& range);
bool edit_number(const char* what, std::uint64_t& value, const NumberRange& range);

/// Whether the options of a table are options of the command line.
template <class S>
inline constexpr bool kIsOnCommandLine = true;
template <>
inline constexpr bool kIsOnCommandLine<ProgressiveSettings> = false;

/// Returns the option's name on the command line, which tooltips show; empty: it has none.
template <class S>
std::string command_line_name(const Option<S>& option) {
  return kIsOnCommandLine<S> ? std::string("--") + option.key : std::string();
}

/// Draws an option of a table with its tooltip, grayed out if it does not apply. Returns whether
/// the value changed.
template <class S>
bool edit_option(const Option<S>& option, S& options) {
  const auto edit = [&](const auto& member) {
    using Member = std::decay_t<decltype(member)>;
    const std::string name = command_line_name(option);
    const std::string help = std::string(option.help) + (name.empty() ? "" : "\n" + name);
    if constexpr (std::is_same_v<Member, EnumMember<S>>) {
      const std::size_t current = member.get(options);
      const std::size_t chosen =
          choose(option.label, member.count, member.text, current, option.help, name);
      if (chosen != current) member.set(options, chosen);
      return chosen != current;
    } else if constexpr (std::is_same_v<Member, bool S::*>) {
      return edit_switch(option.label, options.*member, help);
    } else {
      return edit_number(option.label, options.*member,
                         {option.least, option.most, option.unit, option.special.value,
                          option.special.label, help});
    }
  };
  const bool applies = option.applies == nullptr || option.applies(options);
  begin_disabled(!applies);
  const bool is_changed = std::visit(edit, option.member);
  end_disabled();
  return is_changed;
}

/// Draws all options of a table. Returns whether a value changed.
template <class S, std::size_t N>
bool edit_options(const std::array<Option<S>, N>& table, S& options) {
  bool is_changed = false;
  for (const Option<S>& option : table)
    is_changed |= edit_option(option, options);
  return is_changed;
}

}  // namespace mesher::app
