#include <imgui.h>
#include <imgui_stdlib.h>

#include <cfloat>

#include "app/files/save.h"
#include "app/ui/controls.h"
#include "app/ui/panels.h"
#include "engine/io/format.h"

namespace mesher::app {
namespace {

constexpr float kSaveWidthPoints = 460.0F;

}  // namespace

void draw_save_dialog(Saving& saving, const Document& document, Ui& ui) {
  if (begin_dialog("Save the model", &saving.shows_dialog, kSaveWidthPoints)) {
    faint_text(io::writable_formats() + "; only OBJ stores creases");
    if (ImGui::IsWindowAppearing()) ImGui::SetKeyboardFocusHere();
    ImGui::SetNextItemWidth(-FLT_MIN);
    // Typing replaces the suggestion. `submits` alone reports Enter, as in the open dialog.
    ImGui::InputText("##path", &saving.typed, ImGuiInputTextFlags_AutoSelectAll);
    const bool overwrites = !saving.asked.empty() && !saving.remark.empty();
    if (wide_button(overwrites ? "Overwrite###save" : "Save###save", true, "Enter") || ui.submits)
      submit_save(saving, document);
    if (!saving.remark.empty()) remark_text(saving.remark);
  }
  end_dialog(ui.areas);
}

}  // namespace mesher::app
