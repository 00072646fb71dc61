#pragma once

#include <cstddef>
#include <span>
#include <string>

#include "app/ui/panels.h"

namespace mesher::app {

// What the panels at the right border are made of.

/// Begins a panel below `top`; false where it is folded. End it with `end_side_panel` either way.
/// With `is_open` it has a cross, and is never folded by itself.
bool begin_side_panel(const char* title, float top, bool* is_open = nullptr);
/// Notes its area; returns where it ends.
float end_side_panel(PanelAreas& areas);

/// Where the second column begins.
inline constexpr float kFieldX = 112.0F;
/// In the first column; what comes next fills the second.
void label(const char* text);
/// Of the item before, disabled or not.
void tooltip(const char* text);
/// A row of a two-column table.
void row(const char* name, const std::string& value);
/// A button of half the panel's width.
bool half_button(const char* name, bool is_possible, const char* help);
std::string seconds_text(double seconds);
/// "3.4 MB"
std::string size_text(std::uint64_t bytes);

/// A value of an enum, and what it is for.
struct Choice {
  const char* name;
  const char* goal;
};

/// A list to choose from. Returns which one is chosen now.
std::size_t choose(const char* what, std::span<const Choice> choices, std::size_t current);

/// The same for an enum whose values the choices are, in order. Returns whether it changed.
template <class Enum, std::size_t N>
bool choose(const char* what, const Choice (&choices)[N], Enum& value) {
  const auto current = static_cast<std::size_t>(value);
  const std::size_t chosen = choose(what, std::span<const Choice>(choices), current);
  value = static_cast<Enum>(chosen);
  return chosen != current;
}

}  // namespace mesher::app
