#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <type_traits>
#include <variant>

#include "app/ui/panels.h"
#include "engine/core/option.h"

namespace mesher::app {

// The parts of the panels at the right border.

/// Begins a panel below `top`; returns false if it is collapsed. Call `end_side_panel` either way.
/// With `is_open` the panel has a close button and does not start collapsed.
bool begin_side_panel(const char* title, float top, bool* is_open = nullptr);
/// Ends a panel and notes its area; returns its lower end.
float end_side_panel(PanelAreas& areas);

/// Start of the second column, in pixels.
inline constexpr float kFieldX = 112.0F;
/// Writes a label into the first column; the next widget fills the second.
void label(const char* text);
/// Adds a tooltip to the last widget, even if that is disabled.
void tooltip(const char* text);
/// A row of a two-column table.
void row(const char* name, const std::string& value);
/// A button of half the panel's width.
bool half_button(const char* name, bool is_possible, const char* help);

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

/// Draws a labeled field for a number. A range that is at most some tens of times its lower end
/// gets a slider, a wider one a logarithmic slider, an open one a field to drag or type in.
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
