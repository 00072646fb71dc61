#include "app/ui/style.h"

#include <imgui.h>

namespace mesher::app {
namespace {

constexpr Theme kLight{.panel = {0.953F, 0.957F, 0.965F},
                       .field = {1.0F, 1.0F, 1.0F},
                       .button = {0.867F, 0.882F, 0.906F},
                       .hovered = {0.792F, 0.843F, 0.922F},
                       .active = {0.706F, 0.796F, 0.941F},
                       .line = {0.78F, 0.80F, 0.83F},
                       .grab = {0.16F, 0.40F, 0.78F},
                       .text = {0.10F, 0.11F, 0.13F},
                       .faint = {0.29F, 0.32F, 0.37F},
                       .caution = {0.45F, 0.27F, 0.0F},
                       .problem = {0.62F, 0.06F, 0.06F}};
constexpr Theme kDark{.panel = {0.114F, 0.122F, 0.141F},
                      .field = {0.176F, 0.192F, 0.224F},
                      .button = {0.192F, 0.220F, 0.271F},
                      .hovered = {0.204F, 0.263F, 0.361F},
                      .active = {0.161F, 0.318F, 0.557F},
                      .line = {0.25F, 0.27F, 0.31F},
                      .grab = {0.38F, 0.62F, 1.0F},
                      .text = {0.93F, 0.94F, 0.96F},
                      .faint = {0.76F, 0.79F, 0.83F},
                      .caution = {1.0F, 0.82F, 0.55F},
                      .problem = {1.0F, 0.74F, 0.72F}};

ImVec4 to_imgui(const glm::vec3& color) {
  return {color.x, color.y, color.z, 1.0F};
}

}  // namespace

const Theme& theme(render::Background background) {
  return background == render::Background::light ? kLight : kDark;
}

void set_sizes(float scale) {
  ImGuiStyle& style = ImGui::GetStyle();
  style = {};  // ScaleAllSizes multiplies what is there
  style.WindowRounding = 6.0F;
  style.FrameRounding = 4.0F;
  style.GrabRounding = 4.0F;
  style.WindowBorderSize = 1.0F;
  style.FrameBorderSize = 1.0F;  // white fields on a light panel would not be seen
  style.WindowPadding = {12.0F, 8.0F};
  style.ItemSpacing = {8.0F, 5.0F};
  style.GrabMinSize = 14.0F;
  style.ScaleAllSizes(scale);
}

void set_colors(const Theme& theme) {
  ImGui::StyleColorsDark();
  const auto set = [&](const glm::vec3& color, std::initializer_list<ImGuiCol> uses) {
    for (const ImGuiCol use : uses)
      ImGui::GetStyle().Colors[use] = to_imgui(color);
  };
  set(theme.panel, {ImGuiCol_WindowBg, ImGuiCol_PopupBg, ImGuiCol_MenuBarBg, ImGuiCol_TitleBg,
                    ImGuiCol_TitleBgActive, ImGuiCol_TitleBgCollapsed, ImGuiCol_ScrollbarBg});
  set(theme.field, {ImGuiCol_FrameBg});
  set(theme.button, {ImGuiCol_Button, ImGuiCol_Header, ImGuiCol_ScrollbarGrab,
                     ImGuiCol_TableHeaderBg, ImGuiCol_Tab, ImGuiCol_TabUnfocused});
  set(theme.hovered, {ImGuiCol_FrameBgHovered, ImGuiCol_ButtonHovered, ImGuiCol_HeaderHovered,
                      ImGuiCol_ScrollbarGrabHovered, ImGuiCol_TabHovered});
  set(theme.active, {ImGuiCol_FrameBgActive, ImGuiCol_ButtonActive, ImGuiCol_HeaderActive,
                     ImGuiCol_ScrollbarGrabActive, ImGuiCol_TextSelectedBg, ImGuiCol_TabActive,
                     ImGuiCol_TabUnfocusedActive});
  set(theme.line,
      {ImGuiCol_Border, ImGuiCol_Separator, ImGuiCol_TableBorderStrong, ImGuiCol_TableBorderLight});
  set(theme.grab, {ImGuiCol_SliderGrab, ImGuiCol_SliderGrabActive, ImGuiCol_CheckMark,
                   ImGuiCol_PlotHistogram, ImGuiCol_NavHighlight});
  set(theme.text, {ImGuiCol_Text});
  set(theme.faint, {ImGuiCol_TextDisabled});
}

const Theme& shown_theme() {
  const ImVec4 panel = ImGui::GetStyleColorVec4(ImGuiCol_WindowBg);
  return panel.x == kLight.panel.x ? kLight : kDark;
}

float units(float points) {
  return points * ImGui::GetFontSize() / kFontPoints;
}

}  // namespace mesher::app
