#include "app/ui/controls.h"

#include <imgui.h>

#include <algorithm>
#include <cfloat>
#include <cinttypes>
#include <cstdio>

namespace mesher::app {
namespace {

constexpr float kWidth = 290.0F;
// Narrower, panels start folded: the model needs the room.
constexpr float kFitsWidth = 1000.0F;

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

std::size_t choose(const char* what, std::span<const Choice> choices, std::size_t current) {
  label(what);
  const std::string id = std::string("##") + what;
  if (!ImGui::BeginCombo(id.c_str(), choices[current].name)) {
    tooltip(choices[current].goal);
    return current;
  }
  std::size_t chosen = current;
  for (std::size_t i = 0; i < choices.size(); ++i) {
    if (ImGui::Selectable(choices[i].name, i == current)) chosen = i;
    tooltip(choices[i].goal);
  }
  ImGui::EndCombo();
  return chosen;
}

std::string seconds_text(double seconds) {
  constexpr double kShort = 0.1;
  char text[32];
  if (seconds < kShort) {
    std::snprintf(text, sizeof text, "%.2f ms", 1e3 * seconds);
  } else {
    std::snprintf(text, sizeof text, "%.3f s", seconds);
  }
  return text;
}

std::string size_text(std::uint64_t bytes) {
  char text[32];
  if (bytes < 10'000) {
    std::snprintf(text, sizeof text, "%" PRIu64 " bytes", bytes);
  } else {
    std::snprintf(text, sizeof text, "%.*f %s", bytes < 1'000'000 ? 1 : 2,
                  static_cast<double>(bytes) / (bytes < 1'000'000 ? 1e3 : 1e6),
                  bytes < 1'000'000 ? "kB" : "MB");
  }
  return text;
}

}  // namespace mesher::app
