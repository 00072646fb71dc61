#include <imgui.h>
#include <imgui_stdlib.h>

#include "app/files/paths.h"
#include "app/ui/panels.h"
#include "engine/io/format.h"

namespace mesher::app {

void draw_open_dialog(bool& is_open, std::string& typed, bool submits, PanelActions& actions,
                      PanelAreas& areas) {
  const ImVec2 size = ImGui::GetIO().DisplaySize;
  ImGui::SetNextWindowPos({size.x / 2, size.y / 3}, ImGuiCond_Always, {0.5F, 0.5F});
  constexpr ImGuiWindowFlags kFlags =
      ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoCollapse | ImGuiWindowFlags_NoMove;
  if (ImGui::Begin("Open a model", &is_open, kFlags)) {
    ImGui::TextDisabled("%s: a path, or a name in assets/", io::readable_formats().c_str());
    if (ImGui::IsWindowAppearing()) ImGui::SetKeyboardFocusHere();
    ImGui::SetNextItemWidth(380.0F);
    // `submits` alone reports Enter: ImGui sees the key as well, and must not open the file twice.
    ImGui::InputText("##path", &typed, ImGuiInputTextFlags_AutoSelectAll);
    ImGui::SameLine();
    const bool opens = ImGui::Button("Open") || submits;
    const std::filesystem::path path = opens ? typed_path(typed) : std::filesystem::path();
    if (!path.empty()) actions.open = find_model(path.string());
  }
  note_area(areas);
  ImGui::End();
  is_open = is_open && actions.open.empty();
}

}  // namespace mesher::app
