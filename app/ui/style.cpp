#include "app/ui/style.h"

#include <imgui.h>

#include <filesystem>

namespace mesher::app {
namespace {

constexpr const char* kFont = "/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf";
constexpr float kFontPixels = 15.0F;

}  // namespace

void apply_style() {
  ImGuiIO& io = ImGui::GetIO();
  std::error_code ignored;
  // If the font is missing, ImGui uses its own bitmap font.
  if (std::filesystem::exists(kFont, ignored)) io.Fonts->AddFontFromFileTTF(kFont, kFontPixels);
  ImGui::StyleColorsDark();
  ImGuiStyle& style = ImGui::GetStyle();
  style.WindowRounding = 6.0F;
  style.FrameRounding = 4.0F;
  style.GrabRounding = 4.0F;
  style.WindowBorderSize = 0.0F;
  style.WindowPadding = {12.0F, 10.0F};
  style.ItemSpacing = {8.0F, 5.0F};
  style.Colors[ImGuiCol_WindowBg] = {0.11F, 0.12F, 0.14F, 0.92F};
  const ImVec4 title_color{0.16F, 0.18F, 0.22F, 1.0F};
  for (const ImGuiCol title :
       {ImGuiCol_TitleBg, ImGuiCol_TitleBgActive, ImGuiCol_TitleBgCollapsed}) {
    style.Colors[title] = title_color;
  }
}

}  // namespace mesher::app
