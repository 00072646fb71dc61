#include <imgui.h>
#include <imgui_stdlib.h>

#include <cfloat>

#include "app/files/paths.h"
#include "app/ui/controls.h"
#include "app/ui/panels.h"
#include "engine/io/format.h"

namespace mesher::app {
namespace {

constexpr float kOpenWidthPoints = 460.0F;

}  // namespace

void draw_open_dialog(bool& is_open, Ui& ui) {
  if (begin_dialog("Open a model", &is_open, kOpenWidthPoints)) {
    faint_text(io::readable_formats() + ": a path, or a name in assets/");
    if (ImGui::IsWindowAppearing()) ImGui::SetKeyboardFocusHere();
    ImGui::SetNextItemWidth(-FLT_MIN);
    // `submits` alone reports Enter: ImGui sees the key as well, and must not open the file twice.
    ImGui::InputText("##path", &ui.typed_path, ImGuiInputTextFlags_AutoSelectAll);
    const bool opens = wide_button("Open", true, "Enter") || ui.submits;
    const std::filesystem::path path = opens ? typed_path(ui.typed_path) : std::filesystem::path();
    if (!path.empty()) ui.actions.open = find_model(path.string());
  }
  end_dialog(ui.areas);
  is_open = is_open && ui.actions.open.empty();
}

}  // namespace mesher::app
