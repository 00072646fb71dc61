#include "app/ui/controls.h"

#include <imgui.h>

#include <algorithm>
#include <cfloat>
#include <cmath>
#include <string_view>

#include "engine/core/text.h"

namespace mesher::app {
namespace {

constexpr float kWidth = 290.0F;
// In narrower windows panels start collapsed, so that they do not hide the model.
constexpr float kFitsWidth = 1000.0F;
constexpr float kTooltipWidth = 480.0F;

std::string id_of(const char* label) {
  return std::string("##") + label;
}

void wrapped_tooltip(const char* text) {
  if (*text == '\0' || !ImGui::IsItemHovered(ImGuiHoveredFlags_AllowWhenDisabled)) return;
  ImGui::BeginTooltip();
  ImGui::PushTextWrapPos(kTooltipWidth);
  ImGui::TextUnformatted(text);
  ImGui::PopTextWrapPos();
  ImGui::EndTooltip();
}

/// Returns the format for ImGui: "%.0f deg", or the words for a special value.
std::string number_format(double value, const NumberRange& range) {
  if (value == range.special) return range.special_label;
  const std::string_view unit = range.unit;
  if (unit == "deg") return "%.0f deg";
  if (unit == "%") return "%.3f %%";
  if (unit == "px") return "%.2f pixels";
  if (unit == "s") return "%.1f s";
  // A share. ImGui shows a format without a number as it is, and "%%" as "%".
  if (range.most <= 1.0) return percent_text(100.0 * value) + "%";
  return "%.3g";
}

}  // namespace

bool begin_side_panel(const char* title, float top, bool* is_open) {
  const ImVec2 size = ImGui::GetIO().DisplaySize;
  ImGui::SetNextWindowPos({size.x - kPanelMargin, top}, ImGuiCond_Always, {1.0F, 0.0F});
  ImGui::SetNextWindowSizeConstraints({kWidth, 0.0F},
                                      {kWidth, std::max(size.y - top - kPanelMargin, 80.0F)});
  if (is_open == nullptr) ImGui::SetNextWindowCollapsed(size.x < kFitsWidth, ImGuiCond_Once);
  constexpr ImGuiWindowFlags kFlags = ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoMove;
  return ImGui::Begin(title, is_open, kFlags);
}

float end_side_panel(PanelAreas& areas) {
  note_area(areas);
  const float bottom = ImGui::GetWindowPos().y + ImGui::GetWindowSize().y;
  ImGui::End();
  return bottom;
}

void label(const char* text) {
  ImGui::AlignTextToFramePadding();
  ImGui::TextDisabled("%s", text);
  ImGui::SameLine(kFieldX);
  ImGui::SetNextItemWidth(-FLT_MIN);
}

void tooltip(const char* text) {
  if (ImGui::IsItemHovered(ImGuiHoveredFlags_AllowWhenDisabled)) ImGui::SetTooltip("%s", text);
}

void row(const char* name, const std::string& value) {
  ImGui::TableNextRow();
  ImGui::TableNextColumn();
  ImGui::TextDisabled("%s", name);
  ImGui::TableNextColumn();
  ImGui::TextWrapped("%s", value.c_str());
}

bool half_button(const char* name, bool is_possible, const char* help) {
  const float width = (ImGui::GetWindowContentRegionMax().x - ImGui::GetWindowContentRegionMin().x -
                       ImGui::GetStyle().ItemSpacing.x) /
                      2;
  ImGui::BeginDisabled(!is_possible);
  const bool is_pressed = ImGui::Button(name, {width, 0.0F});
  ImGui::EndDisabled();
  tooltip(help);
  return is_pressed;
}

void begin_disabled(bool is_disabled) {
  ImGui::BeginDisabled(is_disabled);
}

void end_disabled() {
  ImGui::EndDisabled();
}

bool edit_switch(const char* what, bool& value, const char* help) {
  label(what);
  const bool is_changed = ImGui::Checkbox(id_of(what).c_str(), &value);
  wrapped_tooltip(help);
  return is_changed;
}

std::size_t choose(const char* what, std::size_t count, const ChoiceText& (*text)(std::size_t),
                   std::size_t current, const char* help) {
  label(what);
  const bool is_open = ImGui::BeginCombo(id_of(what).c_str(), text(current).label);
  if (!is_open) {
    wrapped_tooltip((std::string(help) + ". " + text(current).help).c_str());
    return current;
  }
  std::size_t chosen = current;
  for (std::size_t i = 0; i < count; ++i) {
    if (ImGui::Selectable(text(i).label, i == current)) chosen = i;
    wrapped_tooltip(text(i).help);
  }
  ImGui::EndCombo();
  return chosen;
}

bool edit_number(const char* what, float& value, const NumberRange& range) {
  constexpr double kWide = 50.0;
  label(what);
  const std::string id = id_of(what);
  const std::string format = number_format(value, range);
  const auto least = static_cast<float>(range.least);
  bool is_changed = false;
  if (std::isinf(range.most)) {
    constexpr float kSpeed = 0.002F;
    is_changed = ImGui::DragFloat(id.c_str(), &value, kSpeed, least, 1e6F, format.c_str(),
                                  ImGuiSliderFlags_AlwaysClamp);
  } else {
    const bool is_wide = range.least > 0.0 && range.most >= kWide * range.least;
    is_changed = ImGui::SliderFloat(
        id.c_str(), &value, least, static_cast<float>(range.most), format.c_str(),
        ImGuiSliderFlags_AlwaysClamp | (is_wide ? ImGuiSliderFlags_Logarithmic : 0));
  }
  wrapped_tooltip(range.help);
  return is_changed;
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
  value = std::max(value, static_cast<std::uint64_t>(range.least));
  wrapped_tooltip(range.help);
  return is_changed;
}

}  // namespace mesher::app
