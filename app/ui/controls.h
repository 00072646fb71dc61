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
/// for a name with ###, only what follows it. Notes the name as a text as well.
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
/// Draws a labeled field for a number of things, with commas. Returns whether it changed.
bool edit_count(const char* what, std::uint32_t& value, const char* help);

// The widgets of options.

/// How a number is shown and limited.
struct NumberRange {
  double least;
  double most;
  const char* unit;
  double special;             ///< a value that is shown as words
  const char* special_label;  ///< those words
  const char* help;           ///< tooltip
};

void begin_disabled(bool is_disabled);
void end_disabled();
/// Draws a labeled checkbox. Returns whether it was clicked.
bool edit_switch(const char* what, bool& value, const char* help);

/// Draws a labeled list of choices. `text` returns the words for a choice. Returns the chosen
/// index.
std::size_t choose(const char* what, std::size_t count, const ChoiceText& (*text)(std::size_t),
                   std::size_t current, const char* help);

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
/// gets a slider, a wider one a logarithmic slider, an open one a field to drag or type in. The
/// number stands beside the slider, so that the knob does not cover it.
bool edit_number(const char* what, float& value, const NumberRange& range);
bool edit_number(const char* what, std::uint32_t& value, const NumberRange& range);
bool edit_number(const char* what, std::uint64_t& value, const NumberRange& range);

/// Draws an option of a table with its tooltip, grayed out if it does not apply. Returns whether
/// the value changed.
template <class S>
bool edit_option(const Option<S>& option, S& options) {
  const auto edit = [&](const auto& member) {
    using Member = std::decay_t<decltype(member)>;
    if constexpr (std::is_same_v<Member, EnumMember<S>>) {
      const std::size_t current = member.get(options);
      const std::size_t chosen =
          choose(option.label, member.count, member.text, current, option.help);
      if (chosen != current) member.set(options, chosen);
      return chosen != current;
    } else if constexpr (std::is_same_v<Member, bool S::*>) {
      return edit_switch(option.label, options.*member, option.help);
    } else {
      return edit_number(option.label, options.*member,
                         {option.least, option.most, option.unit, option.special.value,
                          option.special.label, option.help});
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
