#include <imgui.h>
#include <imgui_stdlib.h>

#include <algorithm>
#include <cfloat>

#include "app/input/commands.h"
#include "app/ui/controls.h"
#include "app/ui/panels.h"
#include "app/ui/style.h"

namespace mesher::app {
namespace {

constexpr float kPaletteWidthPoints = 460.0F;
constexpr float kListPoints = 280.0F;

/// Draws a command with its keys. Returns whether it was clicked.
bool draw_command(const Session& session, const Command& command, bool is_chosen) {
  const char* reason = blocked(session, command);
  const std::string keys = keys_text(command);
  const float place = ImGui::GetWindowContentRegionMax().x - ImGui::CalcTextSize(keys.c_str()).x;
  ImGui::BeginDisabled(reason != nullptr);
  const std::string id = std::string(command.label) + "##" + command.id;
  const bool is_clicked = ImGui::Selectable(id.c_str(), is_chosen);
  ImGui::EndDisabled();
  if (is_on(session, command)) check_mark(command.label);
  note_widget(command.id);
  tooltip(reason != nullptr ? reason : command.help);
  if (is_chosen) ImGui::SetScrollHereY();
  if (ImGui::CalcTextSize(command.label).x + units(16.0F) < place) {
    ImGui::SameLine(place);
    ImGui::TextDisabled("%s", keys.c_str());
  }
  return is_clicked;
}

}  // namespace

void draw_palette(Session& session, Ui& ui) {
  if (begin_dialog("Find a command", &session.shows_palette, kPaletteWidthPoints)) {
    if (ImGui::IsWindowAppearing()) {
      ui.palette_filter.clear();
      ImGui::SetKeyboardFocusHere();
    }
    ImGui::SetNextItemWidth(-FLT_MIN);
    if (ImGui::InputTextWithHint("##command", "type to find a command", &ui.palette_filter))
      ui.palette_row = 0;
    note_text(ui.palette_filter);
    const std::vector<const Command*> found = matching_commands(ui.palette_filter);
    ui.palette_row = std::clamp(ui.palette_row + ui.row_moves, 0,
                                std::max(static_cast<int>(found.size()) - 1, 0));
    const float most = ImGui::GetIO().DisplaySize.y - 4.0F * ImGui::GetFrameHeightWithSpacing();
    ImGui::BeginChild("found", {0.0F, std::max(std::min(units(kListPoints), most), 1.0F)});
    for (std::size_t i = 0; i < found.size(); ++i) {
      const bool is_row = static_cast<int>(i) == ui.palette_row;
      if (draw_command(session, *found[i], is_row) || (is_row && ui.submits)) ui.chosen = found[i];
    }
    if (found.empty()) faint_text("No command matches.");
    ImGui::EndChild();
    if (ui.chosen != nullptr) session.shows_palette = false;
  }
  end_dialog(ui.areas);
}

}  // namespace mesher::app
