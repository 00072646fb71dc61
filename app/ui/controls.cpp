#include "app/ui/controls.h"

#include <fmt/format.h>
#include <imgui.h>
#include <imgui_internal.h>
#include <imgui_stdlib.h>

#include <algorithm>
#include <cfloat>
#include <charconv>
#include <cmath>

#include "app/ui/style.h"
#include "engine/core/text.h"

namespace mesher::app {
namespace {

// Lengths in points.
constexpr float kTooltipPoints = 420.0F;
constexpr float kFieldPoints = 124.0F;
constexpr float kValuePoints = 88.0F;
// A narrower panel, as in a window of 300 pixels, has less room for both.
constexpr float kNarrowPoints = 250.0F;
constexpr float kNarrowFieldPoints = 108.0F;
constexpr float kNarrowValuePoints = 46.0F;

std::string id_of(const char* label) {
  return std::string("##") + label;
}

Noted* noted_now() {
  return static_cast<Noted*>(ImGui::GetIO().UserData);
}

bool is_narrow() {
  const std::string_view window = ImGui::GetCurrentWindowRead()->RootWindow->Name;
  return window == kToolPanel && ImGui::GetWindowContentRegionMax().x < units(kNarrowPoints);
}

/// Where the second column of a panel begins.
float field_start() {
  return units(is_narrow() ? kNarrowFieldPoints : kFieldPoints);
}

/// The room for a text beside a slider or a field.
float value_room(const std::string& text) {
  if (!is_narrow()) return units(kValuePoints);
  return std::max(units(kNarrowValuePoints), ImGui::CalcTextSize(text.c_str()).x + units(10.0F));
}

void wrapped_tooltip(const char* text) {
  if (*text == '\0' || !ImGui::IsItemHovered(ImGuiHoveredFlags_AllowWhenDisabled)) return;
  if (const Noted* noted = noted_now(); noted != nullptr && !noted->shows_tooltips) return;
  note_text(text);
  ImGui::BeginTooltip();
  ImGui::PushTextWrapPos(
      std::min(units(kTooltipPoints), ImGui::GetIO().DisplaySize.x - units(24.0F)));
  ImGui::TextUnformatted(text);
  ImGui::PopTextWrapPos();
  ImGui::EndTooltip();
}

/// As ImGui: what follows ### is all of the id, and what follows ## is not shown.
std::string_view id_of_widget(std::string_view name) {
  const std::size_t whole = name.find("###");
  return whole != std::string_view::npos ? name.substr(whole + 3) : name.substr(0, name.find("##"));
}

bool sized_button(const char* name, float width, bool is_possible, const char* help) {
  ImGui::BeginDisabled(!is_possible);
  const bool is_pressed = ImGui::Button(name, {width, 0.0F});
  ImGui::EndDisabled();
  note_widget(name);
  wrapped_tooltip(help);
  return is_pressed;
}

/// Returns the text beside a slider: "30 deg", or the words for a special value.
std::string value_text(double value, const NumberRange& range) {
  if (value == range.special) return range.special_label;
  const std::string_view unit = range.unit;
  if (unit == "deg") return fmt::format("{:.0f} deg", value);
  if (unit == "%") return percent_text(value);
  if (unit == "px") return fmt::format("{:.3g} px", value);
  if (unit == "s") return seconds_text(value);
  return range.most <= 1.0 ? percent_text(100.0 * value) : number_text(value);
}

/// Reads a number as it was typed; an empty text is the special value. Returns whether the value
/// changed: not while a number is incomplete.
bool take_number(std::string_view typed, float& value, const NumberRange& range) {
  const float before = value;
  while (typed.ends_with(' ') || typed.ends_with('%'))
    typed.remove_suffix(1);
  if (typed.empty() && !std::isnan(range.special)) {
    value = static_cast<float>(range.special);
    return value != before;
  }
  float number = 0.0F;
  const char* end = typed.data() + typed.size();
  const auto [stop, error] = std::from_chars(typed.data(), end, number);
  if (error != std::errc() || stop != end || !std::isfinite(number)) return false;
  value = std::max(number, static_cast<float>(range.least));
  return value != before;
}

}  // namespace

void note_in(Noted& noted) {
  ImGui::GetIO().UserData = &noted;
}

void note_text(std::string_view text) {
  Noted* noted = noted_now();
  if (noted != nullptr) noted->code_points.add_text(text);
}

void note_code_points(const CodePoints& code_points) {
  Noted* noted = noted_now();
  if (noted != nullptr) noted->code_points.add(code_points);
}

void note_widget(std::string_view name) {
  Noted* noted = noted_now();
  if (noted == nullptr) return;
  noted->code_points.add_text(name);
  const ImVec2 scale = ImGui::GetIO().DisplayFramebufferScale;
  ImVec2 least = ImGui::GetItemRectMin();
  ImVec2 most = ImGui::GetItemRectMax();
  // What is scrolled out of sight cannot be clicked.
  const ImRect& seen = ImGui::GetCurrentWindowRead()->ClipRect;
  least = {std::max(least.x, seen.Min.x), std::max(least.y, seen.Min.y)};
  most = {std::min(most.x, seen.Max.x), std::min(most.y, seen.Max.y)};
  if (most.x <= least.x || most.y <= least.y) return;
  // A child window is named "parent/child_id".
  const std::string_view window = ImGui::GetCurrentWindowRead()->RootWindow->Name;
  const std::string key =
      fmt::format("{}/{}", window.substr(0, window.find("##")), id_of_widget(name));
  // Equal names, such as those of tabs, get a number each.
  std::string unique = key;
  for (int number = 2; noted->widgets.contains(unique); ++number)
    unique = fmt::format("{} ({})", key, number);
  noted->widgets[unique] = {least.x * scale.x, least.y * scale.y, most.x * scale.x,
                            most.y * scale.y};
}

void note_area(PanelAreas& areas) {
  const ImVec2 at = ImGui::GetWindowPos();
  const ImVec2 size = ImGui::GetWindowSize();
  // ImGui uses the window's units, and mouse events use pixels. They differ on scaled displays.
  const ImVec2 scale = ImGui::GetIO().DisplayFramebufferScale;
  areas.emplace_back(at.x * scale.x, at.y * scale.y, (at.x + size.x) * scale.x,
                     (at.y + size.y) * scale.y);
}

bool begin_part(const char* name, const Rect& place, bool has_margin) {
  if (place.is_empty()) return false;
  constexpr ImGuiWindowFlags kFlags = ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoMove |
                                      ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoCollapse |
                                      ImGuiWindowFlags_NoFocusOnAppearing |
                                      ImGuiWindowFlags_NoBringToFrontOnFocus;
  ImGui::SetNextWindowPos({place.x0, place.y0});
  ImGui::SetNextWindowSize({place.width(), place.height()});
  ImGui::PushStyleVar(ImGuiStyleVar_WindowRounding, 0.0F);
  ImGui::PushStyleVar(ImGuiStyleVar_WindowMinSize, {1.0F, 1.0F});
  if (!has_margin) ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {units(4.0F), units(4.0F)});
  ImGui::Begin(name, nullptr, kFlags);
  ImGui::PopStyleVar(has_margin ? 2 : 3);
  return true;
}

void end_part(PanelAreas& areas) {
  note_area(areas);
  ImGui::End();
}

bool begin_dialog(const char* title, bool* is_open, float width_points) {
  const ImVec2 size = ImGui::GetIO().DisplaySize;
  const float width = std::min(units(width_points), size.x);
  ImGui::SetNextWindowPos({size.x / 2, size.y / 2}, ImGuiCond_Always, {0.5F, 0.5F});
  ImGui::SetNextWindowSizeConstraints({width, 0.0F}, {width, size.y});
  return ImGui::Begin(
      title, is_open,
      ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoCollapse | ImGuiWindowFlags_NoMove);
}

void end_dialog(PanelAreas& areas) {
  note_area(areas);
  ImGui::End();
}

void heading(const char* name) {
  ImGui::Spacing();
  wrapped_text(name, shown_theme().grab);
  ImGui::Separator();
}

void label(const char* text) {
  ImGui::AlignTextToFramePadding();
  ImGui::TextDisabled("%s", text);
  ImGui::SameLine(field_start());
  ImGui::SetNextItemWidth(-FLT_MIN);
}

void check_mark(const char* text) {
  const ImVec2 least = ImGui::GetItemRectMin();
  const float size = 0.75F * ImGui::GetFontSize();
  ImGui::RenderCheckMark(ImGui::GetWindowDrawList(),
                         {least.x + ImGui::CalcTextSize(text).x + units(12.0F),
                          0.5F * (least.y + ImGui::GetItemRectMax().y - size)},
                         ImGui::GetColorU32(ImGuiCol_CheckMark), size);
}

bool ellipsis_text(const std::string& text, float end, bool is_possible) {
  note_text(text);
  const ImVec2 least = ImGui::GetItemRectMin();
  const ImVec2 most = ImGui::GetItemRectMax();
  const ImVec2 from{least.x + ImGui::GetStyle().ItemSpacing.x * 0.5F,
                    0.5F * (least.y + most.y - ImGui::GetFontSize())};
  if (!is_possible)
    ImGui::PushStyleColor(ImGuiCol_Text, ImGui::GetStyleColorVec4(ImGuiCol_TextDisabled));
  ImGui::RenderTextEllipsis(ImGui::GetWindowDrawList(), from, {end, most.y}, end, end, text.c_str(),
                            text.c_str() + text.size(), nullptr);
  if (!is_possible) ImGui::PopStyleColor();
  return from.x + ImGui::CalcTextSize(text.c_str()).x <= end;
}

float content_end() {
  return ImGui::GetCursorScreenPos().x + ImGui::GetContentRegionAvail().x;
}

void tooltip(const char* text) {
  wrapped_tooltip(text);
}

bool begin_rows(const char* name) {
  if (!ImGui::BeginTable(name, 2, ImGuiTableFlags_SizingFixedFit)) return false;
  ImGui::TableSetupColumn("what", ImGuiTableColumnFlags_WidthFixed,
                          field_start() - 2 * ImGui::GetStyle().ItemSpacing.x);
  ImGui::TableSetupColumn("value", ImGuiTableColumnFlags_WidthStretch);
  return true;
}

void row(const char* name, const std::string& value) {
  note_text(value);
  ImGui::TableNextRow();
  ImGui::TableNextColumn();
  ImGui::PushTextWrapPos(0.0F);
  ImGui::TextDisabled("%s", name);
  ImGui::PopTextWrapPos();
  ImGui::TableNextColumn();
  ImGui::TextWrapped("%s", value.c_str());
}

bool half_button(const char* name, bool is_possible, const char* help) {
  const float width = (ImGui::GetWindowContentRegionMax().x - ImGui::GetWindowContentRegionMin().x -
                       ImGui::GetStyle().ItemSpacing.x) /
                      2;
  return sized_button(name, width, is_possible, help);
}

bool wide_button(const char* name, bool is_possible, const char* help) {
  return sized_button(name, -FLT_MIN, is_possible, help);
}

void wrapped_text(const std::string& text, const glm::vec3& color) {
  note_text(text);
  ImGui::PushStyleColor(ImGuiCol_Text, {color.x, color.y, color.z, 1.0F});
  ImGui::PushTextWrapPos(0.0F);
  ImGui::TextUnformatted(text.c_str());
  ImGui::PopTextWrapPos();
  ImGui::PopStyleColor();
}

void faint_text(const std::string& text) {
  const ImVec4 faint = ImGui::GetStyleColorVec4(ImGuiCol_TextDisabled);
  wrapped_text(text, {faint.x, faint.y, faint.z});
}

void remark_text(const std::string& text) {
  wrapped_text(text, shown_theme().caution);
}

void problem_text(const std::string& text) {
  wrapped_text(text, shown_theme().problem);
}

bool edit_count(const char* what, std::uint32_t& value, const char* help, const char* none) {
  label(what);
  const bool can_be_none = none != nullptr;
  std::string text = can_be_none && value == 0 ? "" : count_text(value);
  const bool is_changed =
      ImGui::InputTextWithHint(id_of(what).c_str(), can_be_none ? none : "", &text);
  note_widget(what);
  wrapped_tooltip(help);
  if (!is_changed) return false;
  std::erase_if(text, [](char c) { return c == ',' || c == ' '; });
  std::uint32_t typed = 0;
  if (can_be_none && text.empty()) {
    value = 0;
    return true;
  }
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), typed);
  if (error != std::errc() || end != text.data() + text.size()) return false;
  value = typed;
  return true;
}

void begin_disabled(bool is_disabled) {
  ImGui::BeginDisabled(is_disabled);
}

void end_disabled() {
  ImGui::EndDisabled();
}

bool edit_switch(const char* what, bool& value, const std::string& help) {
  label(what);
  const bool is_changed = ImGui::Checkbox(id_of(what).c_str(), &value);
  note_widget(what);
  wrapped_tooltip(help.c_str());
  return is_changed;
}

std::size_t choose(const char* what, std::size_t count, const ChoiceText& (*text)(std::size_t),
                   std::size_t current, const char* help, const std::string& option) {
  label(what);
  const auto help_of = [&](std::size_t i) {
    const std::string name = option.empty() ? "" : "\n" + option + " " + text(i).key;
    return text(i).help + name;
  };
  const bool is_open = ImGui::BeginCombo(id_of(what).c_str(), text(current).label);
  if (!is_open) {
    note_widget(what);
    wrapped_tooltip((std::string(help) + ". " + help_of(current)).c_str());
    return current;
  }
  std::size_t chosen = current;
  for (std::size_t i = 0; i < count; ++i) {
    if (ImGui::Selectable(text(i).label, i == current)) chosen = i;
    note_widget(text(i).label);
    if (i == current) ImGui::SetItemDefaultFocus();
    wrapped_tooltip(help_of(i).c_str());
  }
  ImGui::EndCombo();
  note_widget(what);
  return chosen;
}

bool edit_slider(const char* what, float& value, const SliderRange& range, const std::string& text,
                 const char* help) {
  label(what);
  ImGui::SetNextItemWidth(-value_room(text));
  const ImGuiSliderFlags flags =
      ImGuiSliderFlags_AlwaysClamp | (range.is_logarithmic ? ImGuiSliderFlags_Logarithmic : 0);
  const bool is_changed =
      ImGui::SliderFloat(id_of(what).c_str(), &value, range.least, range.most, "", flags);
  note_widget(what);
  wrapped_tooltip(help);
  // The item of what the caller asks next is the slider.
  const bool is_activated = ImGui::IsItemActivated();
  ImGui::SameLine();
  ImGui::TextUnformatted(text.c_str());
  if (range.is_activated != nullptr) *range.is_activated = is_activated;
  return is_changed;
}

bool edit_number(const char* what, float& value, const NumberRange& range) {
  constexpr double kWide = 50.0;
  if (!std::isinf(range.most)) {
    const bool is_wide = range.least > 0.0 && range.most >= kWide * range.least;
    return edit_slider(what, value,
                       {static_cast<float>(range.least), static_cast<float>(range.most), is_wide},
                       value_text(value, range), range.help.c_str());
  }
  const bool is_special = static_cast<double>(value) == range.special;
  std::string typed = is_special ? "" : fmt::format("{:.6g}", value);
  label(what);
  const bool has_unit = *range.unit != '\0';
  if (has_unit) ImGui::SetNextItemWidth(-value_room(range.unit));
  const bool is_changed =
      ImGui::InputTextWithHint(id_of(what).c_str(), range.special_label, &typed);
  note_widget(what);
  wrapped_tooltip(range.help.c_str());
  if (has_unit) {
    ImGui::SameLine();
    ImGui::TextUnformatted(range.unit);
  }
  return is_changed && take_number(typed, value, range);
}

bool edit_number(const char* what, std::uint32_t& value, const NumberRange& range) {
  std::uint64_t wide = value;
  const bool is_changed = edit_number(what, wide, range);
  value = static_cast<std::uint32_t>(std::min<std::uint64_t>(wide, UINT32_MAX));
  return is_changed;
}

bool edit_number(const char* what, std::uint64_t& value, const NumberRange& range) {
  label(what);
  constexpr std::uint64_t kStep = 1;
  const bool is_changed =
      ImGui::InputScalar(id_of(what).c_str(), ImGuiDataType_U64, &value, &kStep);
  note_widget(what);
  value = std::max(value, static_cast<std::uint64_t>(range.least));
  if (!std::isinf(range.most)) value = std::min(value, static_cast<std::uint64_t>(range.most));
  wrapped_tooltip(range.help.c_str());
  return is_changed;
}

}  // namespace mesher::app
