#include <imgui.h>
#include <imgui_stdlib.h>

#include "app/files/save.h"
#include "app/ui/panels.h"
#include "engine/io/format.h"

namespace mesher::app {

void draw_save_dialog(Saving& saving, const Document& document, bool submits, PanelAreas& areas) {
  const ImVec2 size = ImGui::GetIO().DisplaySize;
  ImGui::SetNextWindowPos({size.x / 2, size.y / 3}, ImGuiCond_Always, {0.5F, 0.5F});
  constexpr ImGuiWindowFlags kFlags =
      ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoCollapse | ImGuiWindowFlags_NoMove;
  if (ImGui::Begin("Save the model", &saving.shows_dialog, kFlags)) {
    ImGui::TextDisabled("%s; only OBJ stores creases", io::writable_formats().c_str());
    if (ImGui::IsWindowAppearing()) ImGui::SetKeyboardFocusHere();
    ImGui::SetNextItemWidth(380.0F);
    // Typing replaces the suggestion. `submits` alone reports Enter, as in the open dialog.
    ImGui::InputText("##path", &saving.typed, ImGuiInputTextFlags_AutoSelectAll);
    ImGui::SameLine();
    const bool overwrites = !saving.asked.empty() && !saving.remark.empty();
    if (ImGui::Button(overwrites ? "Overwrite###save" : "Save###save") || submits) {
      submit_save(saving, document);
    }
    if (!saving.remark.empty()) {
      ImGui::TextColored({1.0F, 0.75F, 0.4F, 1.0F}, "%s", saving.remark.c_str());
    }
  }
  note_area(areas);
  ImGui::End();
}

}  // namespace mesher::app
